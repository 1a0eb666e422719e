#include "lib/grid/shelf_stream.h"

#include <algorithm>

namespace bp {

ShelfSource::ShelfSource(StreamHeader header, BrickShelf& solid, BrickShelf* closing, Keep keep)
    : header_(std::move(header)), shelves_{&solid, closing}, keep_(keep) {
  for (const Layer layer : {Layer::solid, Layer::closing}) {
    if (shelves_[std::size_t(layer)] == nullptr) continue;
    for (const BrickCoord c : shelves_[std::size_t(layer)]->coords()) places_.push_back({c, layer});
  }
  std::sort(places_.begin(), places_.end(), [&](const Place& a, const Place& b) {
    return a.coord == b.coord ? a.layer < b.layer : slab_order(header_.slab_axis, a.coord, b.coord);
  });
}

bool ShelfSource::read(Brick& out) {
  if (next_ == places_.size()) return false;
  const Place& place = places_[next_++];
  BrickShelf& shelf = *shelves_[std::size_t(place.layer)];
  out.coord = place.coord;
  out.layer = place.layer;
  out.fill = shelf.get(place.coord, out.bits);
  if (keep_ == Keep::solid && place.layer == Layer::closing) shelf.drop(place.coord);
  return true;
}

}  // namespace bp
