#include "io/stream/brick_tally.h"

#include <vector>

#include "io/store/brick_codec.h"
#include "io/stream/stream_format.h"
#include "lib/core/parallel.h"

namespace bp {

namespace {

struct Tallied {
  Brick brick;
  StreamTotals totals;
};

void tally(Tallied& item) {
  const detail::Record record{item.brick.coord, item.brick.layer, item.brick.fill};
  std::vector<std::byte> planes;
  if (record.fill == BrickFill::mixed) {
    planes.resize(detail::kBrickBytes);
    detail::to_planes(item.brick.bits, planes.data());
  }
  item.totals = detail::total({&record, 1}, planes);
}

}  // namespace

StreamTotals totals_of(BrickSource& source) {
  StreamTotals all;
  pipeline<Tallied>(
      2 * thread_count(), [&](Tallied& item) { return source.read(item.brick); }, tally,
      [&](Tallied& item) { all.add(item.totals); });
  return all;
}

}  // namespace bp
