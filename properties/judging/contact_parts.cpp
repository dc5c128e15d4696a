#include "properties/judging/contact_parts.h"

#include <map>

namespace assay::properties {
namespace {

class Parts {
 public:
  std::int32_t root(std::int32_t node) {
    auto parent = parent_.try_emplace(node, node).first;
    while (parent->second != parent->first) {
      const auto above = parent_.find(parent->second);
      parent->second = above->second;
      parent = above;
    }
    return parent->first;
  }
  void join(std::int32_t a, std::int32_t b) { parent_[root(a)] = root(b); }

 private:
  std::map<std::int32_t, std::int32_t> parent_;
};

}  // namespace

std::vector<ContactPart> contact_parts(const std::vector<detector::PairContact>& pairs,
                                       const detector::TimeEnclosure& time) {
  Parts parts;
  for (const auto& contact : pairs) {
    if (contact.time == time) parts.join(contact.pair.a, contact.pair.b);
  }
  std::map<std::int32_t, ContactPart> by_root;
  for (const auto& contact : pairs) {
    if (contact.time == time) by_root[parts.root(contact.pair.a)].push_back(contact);
  }
  std::vector<ContactPart> list;
  for (auto& [root, part] : by_root) list.push_back(std::move(part));
  return list;
}

}  // namespace assay::properties
