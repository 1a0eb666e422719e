#include "io/scene/detail/block_cache.h"

#include <algorithm>

#include "lib/core/error.h"

namespace bp {

BlockCache::BlockCache(SceneFilePtr file, std::uint64_t budget_bytes)
    : file_(std::move(file)),
      sets_(std::max<std::size_t>(1, std::size_t(budget_bytes / kBlockBytes / kWays))),
      slots_(sets_ * kWays),
      last_(slots_.data()) {}

const BlockCache::Slot& BlockCache::find(std::uint64_t block) {
  Slot* const set = &slots_[std::size_t(block % sets_) * kWays];
  Slot* oldest = set;
  for (Slot* slot = set; slot != set + kWays; ++slot) {
    if (slot->block == block) {
      slot->used = ++clock_;
      return *(last_ = slot);
    }
    if (slot->used < oldest->used) oldest = slot;
  }
  load(*oldest, block);
  return *(last_ = oldest);
}

void BlockCache::load(Slot& slot, std::uint64_t block) {
  ++misses_;
  if (!slot.data) slot.data.reset(new std::byte[kBlockBytes]);
  slot.block = ~std::uint64_t(0);  // stays so if the read throws
  slot.bytes = file_->read_at(block * kBlockBytes, {slot.data.get(), kBlockBytes});
  slot.block = block;
  slot.used = ++clock_;
}

void BlockCache::fail_short(std::uint64_t end) const {
  fail(ErrorCode::bad_input, "{}: ends at byte {}, but data up to byte {} is needed; the file is truncated",
       file_->name(), file_->size(), end);
}

}  // namespace bp
