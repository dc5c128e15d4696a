#include "reports/bench/gnuplot.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstring>
#include <memory>

extern char** environ;

namespace assay::reports {
namespace {

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using TemporaryFile = std::unique_ptr<std::FILE, Close>;

std::string contents(std::FILE* file) {
  std::rewind(file);
  std::string text;
  char buffer[1 << 14];
  for (std::size_t n; (n = std::fread(buffer, 1, sizeof buffer, file)) > 0;) text.append(buffer, n);
  return text;
}

// Returns the exit status of gnuplot. If it could not be run, returns the errno that says why, as
// a number below 0.
int run(std::FILE* in, std::FILE* out, std::FILE* err) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, fileno(in), 0);
  posix_spawn_file_actions_adddup2(&actions, fileno(out), 1);
  posix_spawn_file_actions_adddup2(&actions, fileno(err), 2);
  char program[] = "gnuplot", from_input[] = "-";
  char* arguments[] = {program, from_input, nullptr};
  pid_t child = 0;
  const int error = posix_spawnp(&child, program, &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) return -error;
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

}  // namespace

Drawing draw(const std::string& script) {
  const TemporaryFile in(std::tmpfile()), out(std::tmpfile()), err(std::tmpfile());
  if (!in || !out || !err) return {{}, "no temporary file could be made to draw with"};
  std::fwrite(script.data(), 1, script.size(), in.get());
  std::fflush(in.get());
  std::rewind(in.get());
  const int status = run(in.get(), out.get(), err.get());
  if (status == -ENOENT) {
    return {{}, "pictures are drawn by gnuplot, which is not here: install gnuplot-nox"};
  }
  if (status < 0) return {{}, fmt::format("gnuplot cannot be run: {}", std::strerror(-status))};
  std::string svg = contents(out.get()), said = contents(err.get());
  if (status != 0 || svg.find("</svg>") == std::string::npos) {
    for (char& c : said) c = c == '\n' ? ' ' : c;
    return {{}, "gnuplot drew nothing: " + said};
  }
  return {std::move(svg), {}};
}

std::string cannot_draw() { return draw("set terminal svg\nplot x\n").problem; }

}  // namespace assay::reports
