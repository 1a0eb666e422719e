#include "io/scene/detail/obj/mtl_file.h"

#include <algorithm>
#include <functional>
#include <tuple>
#include <utility>

#include "io/files/beside.h"
#include "io/scene/detail/text/text_scanner.h"
#include "lib/core/error.h"

namespace bp {

namespace {

/// Returns the share, or as much of it as is `most` of the rest of its limit.
MemoryShare at_most(MemoryShare memory, double most) {
  const double part = memory.share > 0 ? std::min(1.0, most / memory.share) : most;
  memory.bytes = std::uint64_t(double(memory.bytes) * part);
  memory.share *= part;
  memory.least_share = std::min(memory.least_share, most);
  return memory;
}

std::uint32_t hash_of(const std::string& name) {
  return std::uint32_t(std::hash<std::string>()(name));
}

}  // namespace

MtlMaterials::MtlMaterials(const MemoryShare& document)
    : is_limited_(document.bytes > 0), memory_(at_most(document, kMostShare)) {}

void MtlMaterials::load(const std::string& beside, const std::string& name) {
  if (beside.empty() || name.empty()) return;
  try {
    const std::string path = find_beside(folder_before(beside), name);
    const auto [found, is_new] = file_numbers_.try_emplace(path, std::uint32_t(files_.size()));
    if (is_new) files_.push_back({&found->first, 0});
    File& file = files_[found->second];
    if (file.loaded != loads_ || is_new) kept_.clear(), kept_bytes_ = 0, file.loaded = ++loads_;
    if (!is_new) return;
    if (fit()) too_many_ = path;
    list(path, found->second);
  } catch (const Error&) {
    return;
  }
}

void MtlMaterials::refuse() const {
  throw NeedsMemory(fmt::format("{}: the list of materials", too_many_), bytes(), memory_.bytes,
                    memory_.limit_for(bytes()));
}

void MtlMaterials::clear() {
  file_numbers_.clear(), files_.clear();
  places_.clear(), kept_.clear();
  loads_ = count_ = kept_bytes_ = 0;
  open_.reset();
}

/// Lists the materials of a file. If the file is broken further on, those before count.
void MtlMaterials::list(const std::string& path, std::uint32_t file) {
  TextScanner text(open_scene_file(path, "", NamedBy::file));
  std::string name;
  constexpr std::uint64_t kNone = ~std::uint64_t(0);  // add() takes no such offset
  std::uint64_t begin = kNone;
  const auto add_before = [&](std::uint64_t end) { add(name, file, std::exchange(begin, kNone), end); };
  try {
    for (; !text.at_end(); text.next_line()) {
      if (!text.word_on_line() || text.peek() != 'n') continue;
      const std::uint64_t here = text.offset();
      if (text.word() != "newmtl") continue;
      add_before(here);
      if (count_ == kMost) return;
      name = text.rest_of_line();
      begin = here;
    }
  } catch (const Error&) {
    return add_before(text.offset());
  }
  add_before(text.offset());
}

/// Adds the place of a material. Once the places do not fit, it only counts them.
void MtlMaterials::add(const std::string& name, std::uint32_t file, std::uint64_t begin, std::uint64_t end) {
  constexpr std::uint64_t kMostLength = (1ULL << Place::kLengthBits) - 1, kMostOffset = ~0ULL >> Place::kLengthBits;
  if (begin > kMostOffset) return;
  ++count_;
  if (!fit()) return;
  const std::uint64_t length = std::min(end - begin, kMostLength);
  places_.push_back({hash_of(name), file, begin << Place::kLengthBits | length});
  sorted_ = false;
}

/// Returns the material of this name; null if there is none. Valid until the next call.
MtlMaterial* MtlMaterials::find(const std::string& name) {
  // with the tree's links, and bytes that the allocator adds
  constexpr std::uint64_t kNodeBytes = sizeof(decltype(kept_)::value_type) + 6 * sizeof(void*);
  auto found = kept_.find(name);
  if (found == kept_.end()) {
    if (kept_bytes_ > kMostKept) kept_.clear(), kept_bytes_ = 0;
    found = kept_.emplace(name, read(name)).first;
    kept_bytes_ += kNodeBytes + heap_bytes(name) + found->second.heap_bytes();
  }
  return found->second.file == nullptr ? nullptr : &found->second;
}

/// Reads the material of this name: of several, the last one of the file that was loaded last.
MtlMaterial MtlMaterials::read(const std::string& name) {
  const auto by_hash = [](const Place& a, const Place& b) { return a.hash < b.hash; };
  if (!sorted_) std::sort(places_.begin(), places_.end(), by_hash);
  sorted_ = true;
  const auto [first, last] = std::equal_range(places_.begin(), places_.end(), Place{hash_of(name), 0, 0}, by_hash);
  std::vector<Place> candidates(first, last);
  std::sort(candidates.begin(), candidates.end(), [&](const Place& a, const Place& b) {
    return std::make_tuple(files_[a.file].loaded, a.at()) > std::make_tuple(files_[b.file].loaded, b.at());
  });
  MtlMaterial material;
  for (const Place& place : candidates)
    if (read_at(place, name, material)) return material;
  return {};
}

/// Reads the material at a place. Returns false if it has another name. Lines that cannot be read are left out.
bool MtlMaterials::read_at(const Place& place, const std::string& name, MtlMaterial& material) {
  try {
    if (!open_ || open_number_ != place.file)
      open_ = open_scene_file(*files_[place.file].path, "", NamedBy::file), open_number_ = place.file;
    TextScanner text(part_of(open_, place.at(), place.length()));
    if (!text.word_on_line() || text.word() != "newmtl" || text.rest_of_line() != name) return false;
    material.file = files_[place.file].path;
    for (text.next_line(); !text.at_end(); text.next_line())
      if (text.word_on_line()) read_mtl_line(text, std::string(text.word()), material);
  } catch (const Error&) {
    return material.file != nullptr;
  }
  return true;
}

}  // namespace bp
