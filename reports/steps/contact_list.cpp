#include "reports/steps/contact_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <tuple>

#include "oracle/instant/contact_place.h"
#include "reports/steps/step_json.h"
#include "reports/steps/step_text.h"
#include "reports/terminal/words.h"

namespace assay::reports {

bool StepContacts::cross_at_start(const detector::PairContact& contact) const {
  return contact.time.lo == 0 &&
         oracle::triangles_cross(motion.vertices_t0, triangles, contact.pair);
}

bool StepContacts::cross_at_end(const detector::PairContact& contact) const {
  return oracle::triangles_cross(motion.vertices_t1, triangles, contact.pair);
}

std::string StepContacts::text(std::size_t most) const {
  const auto kinds = marks();
  std::vector<std::size_t> shown(pairs.size());
  std::iota(shown.begin(), shown.end(), std::size_t{0});
  const auto count = std::min(most, shown.size());
  std::partial_sort(shown.begin(), shown.begin() + static_cast<std::ptrdiff_t>(count), shown.end(),
                    [&](const auto i, const auto j) {
                      return std::tie(pairs[i].time, kinds[i], pairs[i].pair) <
                             std::tie(pairs[j].time, kinds[j], pairs[j].pair);
                    });
  std::string out;
  for (std::size_t i = 0; i < count; ++i) {
    const auto& contact = pairs[shown[i]];
    const auto& [pair, time, feature] = contact;
    out += fmt::format("  contact: triangles {} and {}{}", pair.a, pair.b, bodies.text(pair));
    if (!is_at_rest) out += fmt::format(" at t = {}", time_text(time));
    out += fmt::format(", {}", properties::name_of(feature.kind));
    if (const auto place = oracle::contact_place(motion, triangles, contact))
      out += fmt::format(" at ({:.9g}, {:.9g}, {:.9g})", place->point[0], place->point[1],
                         place->point[2]);
    out += cross_at_start(contact) ? ", crossing" : ", touching";
    if (time.hi > 0)
      out += cross_at_end(contact) ? "; crossing at the end" : "; not crossing at the end";
    out += "\n";
  }
  if (shown.size() > count)
    out += fmt::format("  ... {} more in contact: --json names all\n", shown.size() - count);
  if (is_at_rest && count > 0 && pairs.size() <= most_told_apart) {
    const auto touching = std::count(kinds.begin(), kinds.end(), touching_mark);
    out += fmt::format("  crossing: {}, touching: {}\n",
                       pairs.size() - static_cast<std::size_t>(touching), touching);
  }
  return out;
}

std::vector<std::uint8_t> StepContacts::marks() const {
  std::vector<std::uint8_t> marks(pairs.size(), crossing_mark);
  if (!is_at_rest || pairs.size() > most_told_apart) return marks;
  std::transform(pairs.begin(), pairs.end(), marks.begin(), [&](const auto& contact) {
    return cross_at_start(contact) ? crossing_mark : touching_mark;
  });
  return marks;
}

nlohmann::ordered_json StepContacts::json() const {
  using Json = nlohmann::ordered_json;
  Json list = Json::array();
  for (const auto& contact : pairs) {
    Json json = to_json(contact, bodies);
    json["meeting"] = cross_at_start(contact) ? "crossing" : "touching";
    json["crosses_at_end"] = is_at_rest ? Json() : Json(cross_at_end(contact));
    const auto place = oracle::contact_place(motion, triangles, contact);
    json["point"] = place ? Json(place->point) : Json();
    json["barycentric"] = place ? Json(place->barycentric) : Json();
    json["error"] = place ? Json(place->error) : Json();
    json["normal"] = place && place->normal ? Json(*place->normal) : Json();
    list.push_back(std::move(json));
  }
  return list;
}

std::string rest_text(const std::vector<detector::PairContact>& pairs,
                      const properties::BodyNames& bodies) {
  if (bodies.empty())
    return pairs.empty() ? "the mesh does not meet itself"
                         : "the mesh meets itself: " + pairs_text(pairs.size());
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> counts;
  for (const auto& contact : pairs) {
    const auto [low, high] =
        std::minmax(bodies.of(contact.pair.a).body, bodies.of(contact.pair.b).body);
    ++counts[{low, high}];
  }
  if (counts.empty()) return "no body meets another or itself";
  constexpr std::size_t most_listed = 10;
  std::vector<std::string> list;
  for (const auto& [two, count] : counts) {
    if (list.size() == most_listed) break;
    list.push_back(
        fmt::format("body {} meets {}: {}", two.first,
                    two.first == two.second ? "itself" : fmt::format("body {}", two.second),
                    pairs_text(count)));
  }
  if (counts.size() > most_listed)
    list.push_back(fmt::format("and {} more", counts.size() - most_listed));
  return joined(list, ", ");
}

}  // namespace assay::reports
