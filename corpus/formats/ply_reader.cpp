#include "corpus/formats/ply_reader.h"

#include <fmt/format.h>

#include <array>
#include <boost/outcome/try.hpp>

#include "corpus/formats/mesh_builder.h"
#include "corpus/formats/ply_body.h"
#include "corpus/formats/ply_header.h"

namespace assay::corpus {
namespace {

// What becomes of a property: a coordinate, the corners of a face, or nothing.
enum class Role { x = 0, y = 1, z = 2, corners, skipped };

Role role_of(const PlyElement& element, const PlyProperty& property) {
  if (element.name == "vertex" && !property.count_type && property.name.size() == 1 &&
      property.name[0] >= 'x' && property.name[0] <= 'z') {
    return static_cast<Role>(property.name[0] - 'x');
  }
  if (element.name == "face" && property.count_type && is_integer(property.type) &&
      (property.name == "vertex_indices" || property.name == "vertex_index")) {
    return Role::corners;
  }
  return Role::skipped;
}

class PlyReader {
 public:
  PlyReader(std::string_view bytes, const PlyHeader& header, const std::filesystem::path& file)
      : header_(header), body_(bytes, header, file), builder_(file), file_(file) {}

  Expected<Mesh> read() {
    for (const PlyElement& element : header_.elements) {
      BOOST_OUTCOME_TRY(read_element(element));
    }
    if (!body_.at_end()) {
      return builder_.problem(body_.place(), "data after the last element of the header");
    }
    return builder_.finish();
  }

 private:
  Expected<void> read_element(const PlyElement& element) {
    if (element.properties.empty()) return boost::outcome_v2::success();
    std::vector<Role> roles;
    std::array<int, 5> found{};
    std::uint64_t least_size = 0;
    for (const PlyProperty& property : element.properties) {
      roles.push_back(role_of(element, property));
      ++found[static_cast<std::size_t>(roles.back())];
      least_size += size_of(property.count_type.value_or(property.type));
    }
    const bool vertices = element.name == "vertex";
    if (vertices && (found[0] != 1 || found[1] != 1 || found[2] != 1)) {
      return problem_in(file_, "element vertex has no x, y, z");
    }
    if (element.name == "face" && found[static_cast<std::size_t>(Role::corners)] != 1) {
      return problem_in(file_,
                        "element face has no list vertex_indices or vertex_index of integers");
    }
    if (!body_.has_room(element.count, least_size)) {
      return builder_.problem(body_.place(),
                              fmt::format("{} times element {} do not fit into the rest of the "
                                          "file",
                                          element.count, element.name));
    }
    for (std::uint64_t row = 0; row < element.count; ++row) {
      BOOST_OUTCOME_TRY(read_row(element, roles, vertices));
    }
    return boost::outcome_v2::success();
  }

  Expected<void> read_row(const PlyElement& element, const std::vector<Role>& roles,
                          bool vertices) {
    const Place place = body_.place();
    std::array<double, 3> x{};
    for (std::size_t i = 0; i < roles.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      if (property.count_type) {
        BOOST_OUTCOME_TRY(read_list(property, roles[i], place));
      } else if (roles[i] == Role::skipped) {
        BOOST_OUTCOME_TRY(body_.skip(property.type, 1));
      } else {
        BOOST_OUTCOME_TRY(value, body_.number(property.type));
        x[static_cast<std::size_t>(roles[i])] = value;
      }
    }
    if (vertices) return builder_.add_vertex(x[0], x[1], x[2], place);
    return boost::outcome_v2::success();
  }

  Expected<void> read_list(const PlyProperty& property, Role role, const Place& place) {
    BOOST_OUTCOME_TRY(count, body_.integer(*property.count_type));
    if (count < 0) return builder_.problem(place, "a list of negative size");
    const auto items = static_cast<std::uint64_t>(count);
    if (!body_.has_room(items, size_of(property.type))) {
      return builder_.problem(
          place, fmt::format("a list of {} items does not fit into the rest of the file", items));
    }
    if (role != Role::corners) return body_.skip(property.type, items);
    corners_.clear();
    for (std::uint64_t i = 0; i < items; ++i) {
      BOOST_OUTCOME_TRY(vertex, body_.integer(property.type));
      corners_.push_back(vertex);
    }
    return builder_.add_polygon(corners_, place);
  }

  const PlyHeader& header_;
  PlyBody body_;
  MeshBuilder builder_;
  const std::filesystem::path& file_;
  std::vector<std::int64_t> corners_;
};

}  // namespace

Expected<Mesh> read_ply(std::string_view bytes, const std::filesystem::path& file) {
  BOOST_OUTCOME_TRY(header, read_ply_header(bytes, file));
  return PlyReader(bytes, header, file).read();
}

}  // namespace assay::corpus
