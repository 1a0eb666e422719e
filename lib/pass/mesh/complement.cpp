#include "lib/pass/mesh/complement.h"

namespace bp {

namespace {

/// Moves `at` to the next brick of `box` in slab order. Returns false after the last one.
bool step(const BrickBox& box, int slab_axis, BrickCoord& at) {
  const int middle = slab_axis == 2 ? 1 : 2, inner = slab_axis == 0 ? 1 : 0;
  for (const int axis : {inner, middle, slab_axis}) {
    if (++at[axis] < box.max[axis]) return true;
    at[axis] = box.min[axis];
  }
  return false;
}

constexpr std::uint64_t kAll = ~std::uint64_t(0);

}  // namespace

void turn(BrickBits& bits) {
  for (std::uint64_t& word : bits) word = ~word;
}

ComplementSource::ComplementSource(BrickSource& source) : source_(source), at_(source.header().bricks.min) {
  left_ = !source.header().bricks.empty();
  more_ = source_.read(next_);
}

bool ComplementSource::read(Brick& out) {
  while (left_) {
    const BrickCoord coord = at_;
    left_ = step(header().bricks, header().slab_axis, at_);
    while (more_ && (next_.layer != Layer::solid || slab_order(header().slab_axis, next_.coord, coord)))
      more_ = source_.read(next_);
    out.coord = coord;
    out.layer = Layer::solid;
    if (more_ && next_.coord == coord) {
      out.bits = next_.bits;
      turn(out.bits);
      out.fill = classify(out.bits);
    } else {
      out.bits.fill(kAll);
      out.fill = BrickFill::full;
    }
    if (out.fill != BrickFill::empty) return true;
  }
  while (more_) more_ = source_.read(next_);  // to the end record
  return false;
}

ComplementSink::ComplementSink(BrickSink& sink, const StreamHeader& header)
    : sink_(sink), box_(header.bricks), axis_(header.slab_axis), at_(header.bricks.min), left_(!box_.empty()) {}

void ComplementSink::write(const Brick& brick) {
  if (!box_.contains(brick.coord)) return;
  if (brick.layer == Layer::solid) {
    solid_ = brick;
    pending_ = true;
    return;
  }
  advance_to(brick.coord);
  closing_ = brick;
  write_turned();
}

void ComplementSink::finish() {
  while (left_) {
    write_full(at_);
    left_ = step(box_, axis_, at_);
  }
}

/// Writes the bricks before `coord` as full: those that were not written are empty, and their complement is full.
void ComplementSink::advance_to(BrickCoord coord) {
  while (left_ && at_ != coord) {
    write_full(at_);
    left_ = step(box_, axis_, at_);
  }
  if (left_) left_ = step(box_, axis_, at_);
}

void ComplementSink::write_full(BrickCoord coord) {
  Brick full;
  full.coord = coord;
  full.fill = BrickFill::full;
  full.bits.fill(kAll);
  sink_.write(full);
  full.layer = Layer::closing;
  sink_.write(full);
}

void ComplementSink::write_turned() {
  if (!pending_ || solid_.coord != closing_.coord) {
    solid_.coord = closing_.coord;
    solid_.bits.fill(0);
  }
  pending_ = false;
  for (Brick* brick : {&solid_, &closing_}) {
    turn(brick->bits);
    brick->fill = classify(brick->bits);
    if (brick->fill != BrickFill::empty) sink_.write(*brick);
  }
  solid_.layer = Layer::solid;
}

BrickBox box_of_bricks(const BrickShelf& shelf) {
  BrickBox box;
  for (const BrickCoord& c : shelf.coords()) box = hull(box, {c, {c.x + 1, c.y + 1, c.z + 1}});
  return box;
}

BrickBox bricks_around(const BrickShelf& shelf) {
  const BrickBox box = box_of_bricks(shelf);
  return box.empty() ? box : box.grown(1);
}

void complement(const BrickShelf& shelf, const BrickBox& box, BrickShelf& out) {
  if (box.empty()) return;
  BrickCoord at = box.min;
  BrickBits bits;
  do {
    shelf.get(at, bits);
    turn(bits);
    const BrickFill fill = classify(bits);
    if (fill != BrickFill::empty) out.put(at, fill, bits);
  } while (step(box, 2, at));
}

}  // namespace bp
