#pragma once
#include <memory>
#include <optional>
#include <string>

#include "lib/grid/stream.h"
#include "tools/cli/common_options.h"

/// Which --scale of bpclose would leave a proxy the faces that were asked for.
namespace bp {

/// A stream as it is, whose solid layer goes onto a shelf on the way.
class SolidKeeper final : public BrickSource {
 public:
  /// Keeps a reference.
  SolidKeeper(BrickSource& source, std::unique_ptr<BrickShelf> shelf) : source_(source), shelf_(std::move(shelf)) {}
  [[nodiscard]] const StreamHeader& header() const override { return source_.header(); }
  bool read(Brick& out) override {
    if (!source_.read(out)) return false;
    if (out.layer == Layer::solid) shelf_->put(out.coord, out.fill, out.bits);
    return true;
  }
  [[nodiscard]] BrickShelf& shelf() { return *shelf_; }

 private:
  BrickSource& source_;
  std::unique_ptr<BrickShelf> shelf_;
};

/// Whether bpclose --scale, and no field, closed or opened the stream.
[[nodiscard]] bool is_closed_by_scale(const StreamHeader& header);

/// Whether a larger scale can be named: the stream was closed by bpclose --scale.
[[nodiscard]] bool has_scale_to_raise(const StreamHeader& header);

/// "4%", in the unit that bpclose was told: enough for so many faces; "" if none is; nothing where that cannot be told.
/// Never throws: the proxy is made by then, and advice is not worth its failure. Shows progress.
///   make_shelf  shares its memory with `solid`
[[nodiscard]] std::optional<std::string> enough_scale(const StreamHeader& header, BrickShelf& solid,
                                                      std::uint64_t faces, const ShelfFactory& make_shelf,
                                                      const CommonOptions& common);

}  // namespace bp
