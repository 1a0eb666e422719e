#include "lib/tighten/detail/tighten_regions.h"

#include <cmath>
#include <memory>

#include "lib/core/parallel.h"
#include "lib/simplify/regions.h"
#include "lib/tighten/detail/thin.h"

namespace bp {

namespace {

/// A proxy that is cut into regions, each with an editor.
class Editors {
 public:
  Editors(Piece& whole, const Enclosed& enclosed, const TightenParams& params, int turn)
      : whole_(whole), regions_(regions_of(whole, params.faces_per_region, turn)), parts_(regions_.size()) {
    for_each([&](std::size_t i) { parts_[i] = std::make_unique<Part>(whole_, regions_[i], enclosed, params); });
  }

  void tighten(const TightenParams& params, TightenCounts& counts) {
    const double volume = std::abs(double(volume6_of(whole_.vertices, whole_.triangles))) / 6;
    for_each([&](std::size_t i) {
      TightenParams own = params;
      own.volume = volume * double(regions_[i].faces.size()) / double(whole_.triangles.size());
      parts_[i]->tightened = tighten_on(parts_[i]->editor, own);
    });
    for (const auto& part : parts_) {
      counts.sweeps = std::max(counts.sweeps, part->tightened.sweeps);
      counts.moves += part->tightened.moves;
      counts.flips += part->tightened.flips;
      counts.tries += part->tightened.tries;
      counts.volume_of_flips += part->tightened.volume_of_flips;
    }
  }

  void thin(std::uint64_t excess) {
    for_each([&](std::size_t i) { parts_[i]->renew_order(); });
    std::vector<CostOrder*> orders;
    for (const auto& part : parts_) orders.push_back(part->order.get());
    take_cheapest(orders, excess);
  }
  void add_work(SimplifyCounts& counts) const {
    for (const auto& part : parts_) counts.add_beside(part->order->counts);
  }

  [[nodiscard]] std::uint64_t removed() const {
    std::uint64_t n = 0;
    for (std::size_t i = 0; i < parts_.size(); ++i) n += regions_[i].faces.size() - parts_[i]->mesh.face_count();
    return n;
  }

  /// Puts the regions back into the proxy. Nothing may be edited afterwards.
  void put_back() {
    for_each([&](std::size_t i) {
      parts_[i]->editor.erase_turned_shells();
      bp::put_back(parts_[i]->mesh, regions_[i], whole_);
    });
    parts_.clear();
    drop_removed(whole_);
  }

 private:
  struct Part {
    Part(const Piece& whole, const Region& region, const Enclosed& enclosed, const ShapeLimits& limits)
        : mesh(mesh_of(whole, region)), editor(mesh, enclosed, limits) {}
    void renew_order() {
      if (!order) order = make_thin_order(editor);
      order->renew();
    }
    HalfEdgeMesh mesh;
    ProxyEditor editor;
    TightenCounts tightened;
    std::unique_ptr<ThinOrder> order;  // null until it is needed
  };

  template <class Body>
  void for_each(const Body& body) {
    parallel_for(std::int64_t(parts_.size()), [&](std::int64_t i) { body(std::size_t(i)); });
  }

  Piece& whole_;
  std::vector<Region> regions_;
  std::vector<std::unique_ptr<Part>> parts_;
};

Piece piece_of(const LatticeMesh& proxy) {
  return {kEverywhere, proxy.vertices, proxy.triangles, {}};
}

/// Moves the piece into the proxy, without shells that bound nothing any more. Returns its volume.
double take(Piece&& whole, bool inwards, LatticeMesh& proxy) {
  HalfEdgeMesh mesh(std::move(whole.vertices), whole.triangles, kEverywhere);
  erase_inner_shells(mesh, inwards);
  LatticeMesh out = mesh.compact(proxy.frame);
  proxy.vertices = std::move(out.vertices);
  proxy.triangles = std::move(out.triangles);
  return volume_of(mesh);
}

/// Tightens the regions that the cells of one turn cut. Adds to the counts of work, and sets volume_after.
void tighten_turn(LatticeMesh& proxy, const Enclosed& enclosed, const TightenParams& params, int turn,
                  TightenCounts& counts) {
  Piece whole = piece_of(proxy);
  const bool inwards = volume6_of(proxy) < 0;
  Editors editors(whole, enclosed, params, turn);
  editors.tighten(params, counts);
  editors.put_back();
  counts.volume_after = take(std::move(whole), inwards, proxy);
}

TightenCounts counts_before(const LatticeMesh& proxy) {
  TightenCounts counts;
  counts.volume_before = double(volume6_of(proxy)) / 6;
  return counts;
}

}  // namespace

void tighten_regions_on(LatticeMesh& proxy, const Enclosed& enclosed, const TightenParams& params,
                        TightenCounts& counts) {
  counts = counts_before(proxy);
  tighten_turn(proxy, enclosed, params, 0, counts);
}

void thin_regions(LatticeMesh& proxy, const Enclosed& enclosed, std::uint64_t faces, const TightenParams& settle,
                  SimplifyCounts& counts) {
  Piece whole = piece_of(proxy);
  const bool inwards = volume6_of(proxy) < 0;
  counts = {};
  counts.faces_in = counts.faces_flat = whole.triangles.size();
  static_assert(kThinStages % 2 == 0);
  for (int stage = 1; stage <= kThinStages; stage += 2) {  // each set of cells serves two stages
    Editors editors(whole, enclosed, settle, stage / 2 + 1);
    const std::uint64_t at_first = whole.triangles.size();
    for (const int half : {stage, stage + 1}) {
      const std::uint64_t wanted = faces_after(half, counts.faces_in, faces), left = at_first - editors.removed();
      editors.thin(left - std::min(left, wanted));
      TightenCounts ignored;
      if (half < kThinStages) editors.tighten(settle, ignored);
    }
    editors.add_work(counts);
    editors.put_back();
  }
  counts.faces_out = whole.triangles.size();
  counts.stop = counts.faces_out <= faces ? StopReason::faces : counts.reason_left();
  static_cast<void>(take(std::move(whole), inwards, proxy));
}

void tighten_regions(LatticeMesh& proxy, const Enclosed& enclosed, const TightenParams& params, TightenCounts& counts) {
  LatticeMesh tight = proxy;
  TightenParams first = params, second = params;
  first.final_sweeps = std::min(params.final_sweeps, 1);  // for the vertices that are locked in the second turn
  first.most_of_flip = 0;
  second.sweeps = 1;
  counts = counts_before(proxy);
  tighten_turn(tight, enclosed, first, 0, counts);
  tighten_turn(tight, enclosed, second, 1, counts);
  if (counts.volume_after - counts.volume_of_flips <= counts.volume_before) {
    proxy = std::move(tight);
  } else {
    counts.volume_after = counts.volume_before;
  }
}

}  // namespace bp
