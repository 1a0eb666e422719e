#include "lib/meshing/tighten_regions.h"

#include <cmath>
#include <memory>

#include "lib/core/parallel.h"
#include "lib/meshing/regions.h"
#include "lib/meshing/thin.h"

namespace bp {

namespace {

/// The proxy cut into regions, each with an editor.
class Editors {
 public:
  Editors(Piece& whole, const Enclosed& enclosed, const TightenParams& params, int turn)
      : whole_(whole), regions_(regions_of(whole, params.faces_per_region, turn)), parts_(regions_.size()) {
    for_each(
        [&](std::size_t i) { parts_[i] = std::make_unique<Part>(whole_, regions_[i], enclosed, params.edge_limit); });
  }

  void tighten(const TightenParams& params, TightenCounts& counts) {
    const double volume = std::abs(double(volume6(whole_))) / 6;
    for_each([&](std::size_t i) {
      TightenParams own = params;
      own.volume = volume * double(regions_[i].faces.size()) / double(whole_.triangles.size());
      tighten_on(parts_[i]->editor, own, parts_[i]->tightened);
    });
    for (const auto& part : parts_) {
      counts.sweeps = std::max(counts.sweeps, part->tightened.sweeps);
      counts.moves += part->tightened.moves;
      counts.flips += part->tightened.flips;
      counts.tries += part->tightened.tries;
    }
  }

  void thin(std::uint64_t excess) {
    for_each([&](std::size_t i) { parts_[i]->order_renewed(); });
    std::vector<CostOrder*> orders;
    for (const auto& part : parts_) orders.push_back(part->order.get());
    take_cheapest(orders, excess);
  }

  [[nodiscard]] std::uint64_t removed() const {
    std::uint64_t n = 0;
    for (std::size_t i = 0; i < parts_.size(); ++i) n += regions_[i].faces.size() - parts_[i]->mesh.face_count();
    return n;
  }

  /// The last step: the proxy as it is now.
  void put_back(SimplifyCounts& counts) {
    for_each([&](std::size_t i) {
      parts_[i]->editor.erase_turned_shells();
      bp::put_back(parts_[i]->mesh, regions_[i], whole_);
    });
    for (const auto& part : parts_) counts.add_beside(part->simplified);
    parts_.clear();
    drop_removed(whole_);
  }

 private:
  struct Part {
    Part(const Piece& whole, const Region& region, const Enclosed& enclosed, const EdgeLimit& edge_limit)
        : mesh(mesh_of(whole, region)), editor(mesh, enclosed, edge_limit, nullptr) {}
    void order_renewed() {
      if (!order) order = std::make_unique<ThinOrder>(editor, simplified);
      order->renew();
    }
    HalfEdgeMesh mesh;
    ProxyEditor editor;
    SimplifyCounts simplified;
    TightenCounts tightened;
    std::unique_ptr<ThinOrder> order;  // once it is needed
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

/// Without the shells that bound nothing any more; returns the volume.
double take(Piece&& whole, bool inwards, LatticeMesh& proxy) {
  HalfEdgeMesh mesh(std::move(whole.vertices), whole.triangles, kEverywhere);
  erase_inner_shells(mesh, inwards);
  LatticeMesh out = mesh.compact(proxy.frame);
  proxy.vertices = std::move(out.vertices);
  proxy.triangles = std::move(out.triangles);
  return double(mesh.volume6()) / 6;
}

}  // namespace

void tighten_regions_on(LatticeMesh& proxy, const Enclosed& enclosed, const TightenParams& params,
                        TightenCounts& counts) {
  Piece whole = piece_of(proxy);
  const int128 before = volume6(whole);
  counts = {};
  SimplifyCounts none;
  Editors editors(whole, enclosed, params, 0);
  editors.tighten(params, counts);
  editors.put_back(none);
  counts.volume_before = double(before) / 6;
  counts.volume_after = take(std::move(whole), before < 0, proxy);
}

void thin_regions(LatticeMesh& proxy, const Enclosed& enclosed, std::uint64_t faces, const TightenParams& settle,
                  SimplifyCounts& counts) {
  Piece whole = piece_of(proxy);
  const bool inwards = volume6(whole) < 0;
  counts = {};
  counts.faces_in = counts.faces_flat = whole.triangles.size();
  static_assert(kThinStages % 2 == 0);
  for (int stage = 1; stage <= kThinStages; stage += 2) {  // two with each set of cells
    Editors editors(whole, enclosed, settle, stage / 2 + 1);
    const std::uint64_t at_first = whole.triangles.size();
    for (const int half : {stage, stage + 1}) {
      const std::uint64_t wanted = faces_after(half, counts.faces_in, faces), left = at_first - editors.removed();
      editors.thin(left - std::min(left, wanted));
      TightenCounts ignored;
      if (half < kThinStages) editors.tighten(settle, ignored);
    }
    editors.put_back(counts);
  }
  counts.faces_out = whole.triangles.size();
  counts.stop = counts.faces_out <= faces   ? StopReason::faces
                : counts.refused_length > 0 ? StopReason::edge_length
                                            : StopReason::nothing_left;
  static_cast<void>(take(std::move(whole), inwards, proxy));
}

void tighten_regions(LatticeMesh& proxy, const Enclosed& enclosed, const TightenParams& params, TightenCounts& counts) {
  LatticeMesh tight = proxy;
  counts = {};
  TightenParams once = params;
  once.final_sweeps = std::min(params.final_sweeps, 1);  // for those that are locked in the last turn
  tighten_regions_on(tight, enclosed, once, counts);
  Piece whole = piece_of(tight);
  SimplifyCounts none;
  Editors editors(whole, enclosed, params, 1);
  once = params;
  once.sweeps = 1;
  editors.tighten(once, counts);
  editors.put_back(none);
  counts.volume_after = take(std::move(whole), counts.volume_before < 0, tight);
  if (counts.volume_after <= counts.volume_before) {
    proxy = std::move(tight);
  } else {
    counts.volume_after = counts.volume_before;
  }
}

}  // namespace bp
