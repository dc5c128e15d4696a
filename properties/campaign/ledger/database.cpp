#include "properties/campaign/ledger/database.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sqlite3.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "properties/campaign/ledger/store_problem.h"

namespace assay::properties {
Database::Database(const std::filesystem::path& file, Mode mode) {
  const int flags =
      mode == Mode::read ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  const int code = sqlite3_open_v2(file.c_str(), &db_, flags, nullptr);
  if (code != SQLITE_OK) {
    const std::string reason =
        fmt::format("{}: {}", file.string(), db_ ? sqlite3_errmsg(db_) : "no memory");
    sqlite3_close(db_);
    throw StoreProblem(reason);
  }
  constexpr int patience_ms = 5000;
  sqlite3_busy_timeout(db_, patience_ms);
}

Database::~Database() { sqlite3_close(db_); }

std::string Database::file() const {
  const char* name = sqlite3_db_filename(db_, "main");
  return name ? name : "store";
}

void Database::run(const std::string& sql) const {
  const int code = sqlite3_exec(db_, sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) throw StoreProblem(fmt::format("{}: {}", file(), sqlite3_errmsg(db_)));
}

void Database::check_whole() const {
  Statement query(*this, "PRAGMA quick_check(1)");
  if (!query.next() || query.text(0) != "ok")
    throw StoreProblem(fmt::format("{}: the file is damaged", file()));
}

Statement::Statement(const Database& database, const std::string& sql) : database_(database) {
  check(sqlite3_prepare_v2(database.handle(), sql.c_str(), -1, &statement_, nullptr));
}

Statement::~Statement() { sqlite3_finalize(statement_); }

Statement& Statement::bind(std::string_view text) {
  check(sqlite3_bind_text(statement_, ++bound_, text.data(), static_cast<int>(text.size()),
                          SQLITE_TRANSIENT));
  return *this;
}

Statement& Statement::bind(std::uint64_t number) {
  check(sqlite3_bind_int64(statement_, ++bound_, static_cast<sqlite3_int64>(number)));
  return *this;
}

bool Statement::next() {
  const int code = sqlite3_step(statement_);
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) check(code);
  return false;
}

std::string Statement::text(int column) const {
  const auto* begin = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
  if (!begin) return "";  // NULL
  return {begin, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column))};
}

std::uint64_t Statement::number(int column) const {
  return static_cast<std::uint64_t>(sqlite3_column_int64(statement_, column));
}

void Statement::check(int code) const {
  if (code == SQLITE_OK) return;
  throw StoreProblem(fmt::format("{}: {}", database_.file(), sqlite3_errmsg(database_.handle())));
}

FileLock::FileLock(const std::filesystem::path& path, On on, const std::string& if_busy) {
  const int flags = on == On::file ? O_RDWR | O_CREAT : O_RDONLY | O_DIRECTORY;
  lock_ = ::open(path.c_str(), flags | O_CLOEXEC, 0666);
  if (lock_ < 0) throw StoreProblem(fmt::format("{}: {}", path.string(), std::strerror(errno)));
  if (::flock(lock_, LOCK_EX | LOCK_NB) == 0) return;
  ::close(lock_);
  throw StoreProblem(if_busy);
}

FileLock::FileLock(FileLock&& other) noexcept : lock_(std::exchange(other.lock_, -1)) {}
FileLock& FileLock::operator=(FileLock&& other) noexcept {
  std::swap(lock_, other.lock_);
  return *this;
}
FileLock::~FileLock() {
  if (lock_ >= 0) ::close(lock_);
}

}  // namespace assay::properties
