#include "gpu/cuda_backend.h"

#include <cuda_runtime.h>

#include <algorithm>
#include <cstring>
#include <new>

#include "gpu/device_closing.h"
#include "gpu/device_properties.h"
#include "gpu/device_weighing.h"
#include "gpu/kernels/bit_kernels.h"
#include "gpu/kernels/device_error.h"
#include "gpu/kernels/tuning.h"
#include "gpu/kernels/voxelize_kernels.h"
#include "gpu/kernels/winding_kernels.h"
#include "gpu/staging.h"
#include "gpu/stream.h"

namespace bp {

namespace {

class CudaBackend final : public Backend {
 public:
  explicit CudaBackend(int device)
      : stream_(device),
        properties_(device_properties(device)),
        name_(fmt::format("cuda:{} {}", device, properties_.name)),
        staging_(stream_.get()),
        closing_({properties_.multiProcessorCount, std::min(kSlabBytes, properties_.totalGlobalMem / kSlabShare)}),
        voxelizer_(properties_.multiProcessorCount),
        winding_(properties_.multiProcessorCount) {
    require_code();
  }
  ~CudaBackend() override { (void)cudaStreamSynchronize(stream_.get()); }

  [[nodiscard]] std::string name() const override { return name_; }
  [[nodiscard]] std::uint64_t pinned_bytes() const override { return 2 * kStagingBytes; }

  void voxelize(std::span<const FixedTriangle> triangles, BitBox& out, std::int64_t slack) override {
    stream_.select();
    const VoxelBox box = out.box();
    if (box.empty() || triangles.empty()) return;
    const std::int64_t plane = std::int64_t(out.words_per_row()) * (box.max.y - box.min.y);
    std::int64_t slices = std::max<std::int64_t>(1, std::int64_t(kVoxelizeBytes / 8) / plane);
    for (std::int64_t z = box.min.z; z < box.max.z;) {
      VoxelBox part = box;
      part.min.z = std::int32_t(z);
      part.max.z = std::int32_t(std::min<std::int64_t>(z + slices, box.max.z));
      try {
        voxelize_part(triangles, slack, part, std::size_t(plane) * std::size_t(part.max.z - part.min.z),
                      out.row(box.min.y, part.min.z));
        z = part.max.z;
      } catch (const OutOfDeviceMemory&) {  // the device is fuller than expected, so smaller steps are taken
        slices = (part.max.z - part.min.z) / 2;
        if (slices == 0) throw;
        make_room();
      }
    }
  }

  void find_crossings(std::span<const FixedTriangle> triangles, const VoxelBox& tile,
                      std::vector<Crossing>& out) override {
    stream_.select();
    if (tile.empty()) return;
    // Kernels count crossings in 32 bits. A triangle crosses each column at most once, so a batch of kCountedCrossings
    // / columns triangles cannot overflow the count.
    const std::uint64_t columns = std::uint64_t(tile.size().x) * std::uint64_t(tile.size().y);
    const std::size_t most = std::size_t(std::clamp<std::uint64_t>(kCountedCrossings / columns, 1, kTriangleBatch));
    if (columns > kCountedCrossings) fail(ErrorCode::bad_argument, "a tile of {} columns is too wide", columns);
    for (std::size_t at = 0; at < triangles.size(); at += most)
      find_in_batch(triangles.subspan(at, std::min(most, triangles.size() - at)), tile, out);
  }

  void fill_winding(std::vector<Crossing>& crossings, std::span<const std::uint64_t> skip,
                    std::span<std::int32_t> numbers, BitBox& bits) override {
    stream_.select();
    if (bits.box().empty()) return;
    if (crossings.size() <= kMostCrossings) {
      try {
        return fill_on_device(crossings, skip, numbers, bits);
      } catch (const OutOfDeviceMemory&) {  // nothing has come back yet
        make_room();
      }
    }
    bp::fill_winding(crossings, bits.box(), skip, numbers, bits);
  }

  void close(const BitBox& solid, const ScaleLattice& scale, const Halo& halo, const ClosingParams& params,
             const VoxelBox& interior, BitBox& closed) override {
    stream_.select();
    closed.reset(interior);
    if (interior.empty()) return;
    try {
      close_at_once(solid, scale, halo, params, interior, closed);
    } catch (const OutOfDeviceMemory&) {
      close_in_halves(solid, scale, halo, params, interior, closed);
    }
  }

  void close_from_shelf(const BrickShelf& solid, const BrickBox& bricks, const ScaleLattice& scale, const Halo& halo,
                        const ClosingParams& params, const VoxelBox& interior, BitBox& closed) override {
    stream_.select();
    if (whole_bricks(interior)) {
      try {
        return close_bricks(solid, bricks, scale, halo, params, interior, closed);
      } catch (const OutOfDeviceMemory&) {
        make_room();
      }
    }
    Backend::close_from_shelf(solid, bricks, scale, halo, params, interior, closed);
  }

  void weigh(const CageCoordinates& coordinates, std::span<const Vec3d> points, bool carry_outside, WeightBlock& out,
             std::span<CoordinateRows::Place> places) override {
    stream_.select();
    weighing_.weigh(
        coordinates, points, carry_outside, staging_, stream_.get(), [this] { make_room(); }, out, places);
  }

 private:
  void require_code() const {
    const cudaError_t error = find_code();
    if (error == cudaErrorMemoryAllocation) check_cuda(error, "loading the kernels");
    if (error == cudaSuccess) return;
    (void)cudaGetLastError();
    throw DeviceError(fmt::format(
        "{} (compute capability {}.{}): this build holds no code that runs there ({}); one with "
        "-DCMAKE_CUDA_ARCHITECTURES={}{} does",
        name_, properties_.major, properties_.minor, cudaGetErrorName(error), properties_.major, properties_.minor));
  }

  /// Voxelizes one part of a tile. `bits`: the words of `part` on the host, contiguous.
  void voxelize_part(std::span<const FixedTriangle> triangles, std::int64_t slack, const VoxelBox& part,
                     std::size_t words, std::uint64_t* bits) {
    out_.grow(2 * words);
    triangles_.grow(std::min(triangles.size(), kTriangleBatch));
    BP_CUDA_CHECK(cudaMemsetAsync(out_.data(), 0, words * 8, stream_.get()));
    for (std::size_t at = 0; at < triangles.size(); at += kTriangleBatch) {
      const std::size_t n = std::min(kTriangleBatch, triangles.size() - at);
      staging_.upload(triangles_.data(), triangles.data() + at, n * sizeof(FixedTriangle));
      voxelizer_.enqueue(triangles_.data(), std::uint32_t(n), slack, part, out_.data(), stream_.get());
    }
    staging_.download_bits(bits, out_.data(), words);
  }

  /// Finds the crossings of a batch. If they are too many for the device, or for one batch, the batch is halved.
  void find_in_batch(std::span<const FixedTriangle> triangles, const VoxelBox& tile, std::vector<Crossing>& out) {
    try {
      if (find_at_once(triangles, tile, out)) return;
    } catch (const OutOfDeviceMemory&) {
      if (triangles.size() == 1) throw;
      make_room();
    }
    const std::size_t half = triangles.size() / 2;
    find_in_batch(triangles.first(half), tile, out);
    find_in_batch(triangles.subspan(half), tile, out);
  }

  /// Finds all crossings in one run. If there are more than kCrossingBatch, it runs again with room for all of them.
  /// Returns false, with `out` unchanged, if several triangles have more than kMostCrossings; the caller then halves
  /// the batch.
  bool find_at_once(std::span<const FixedTriangle> triangles, const VoxelBox& tile, std::vector<Crossing>& out) {
    staging_.upload(triangles_.grow(triangles.size()), triangles.data(), triangles.size_bytes());
    std::uint32_t capacity = kCrossingBatch, found = 0;
    for (;;) {
      winding_.find(triangles_.data(), std::uint32_t(triangles.size()), tile, crossings_.grow(capacity), capacity,
                    count_.grow(1), stream_.get());
      staging_.download(&found, count_.data(), sizeof(found));
      if (found <= capacity) break;
      if (found > kMostCrossings && triangles.size() > 1) return false;
      capacity = found;
    }
    const std::size_t old = out.size();
    out.resize(old + found);
    staging_.download(out.data() + old, crossings_.data(), found * sizeof(Crossing));
    return true;
  }

  /// Fills on the device. If it throws OutOfDeviceMemory, `numbers` and `bits` are untouched.
  void fill_on_device(const std::vector<Crossing>& crossings, std::span<const std::uint64_t> skip,
                      std::span<std::int32_t> numbers, BitBox& bits) {
    staging_.upload(crossings_.grow(crossings.size()), crossings.data(), crossings.size() * sizeof(Crossing));
    staging_.upload(numbers_.grow(numbers.size()), numbers.data(), numbers.size_bytes());
    if (!skip.empty()) staging_.upload(skip_.grow(2 * skip.size()), skip.data(), skip.size_bytes());
    out_.grow(2 * std::size_t(bits.word_count()));
    winding_.fill(crossings_.data(), std::uint32_t(crossings.size()), bits.box(), skip.empty() ? nullptr : skip_.data(),
                  numbers_.data(), out_.data(), stream_.get());
    staging_.download_bits(bits.data(), out_.data(), std::size_t(bits.word_count()));
    staging_.download(numbers.data(), numbers_.data(), numbers.size_bytes());
  }

  void close_at_once(const BitBox& solid, const ScaleLattice& scale, const Halo& halo, const ClosingParams& params,
                     const VoxelBox& interior, BitBox& closed) {
    const TileLayout layout = lay_out(solid.box(), scale, halo, interior);
    const std::size_t words_in = std::size_t(solid.word_count()) * 2, words_out = std::size_t(closed.word_count()) * 2;
    in_.grow(words_in);
    out_.grow(words_out);
    staging_.upload(in_.data(), solid.data(), words_in * 4);
    CubesOver cubes;
    const TileField field = upload_field(scale, params, interior.grown(halo.erosion_vox), layout, cubes);
    closing_.enqueue(layout, in_.data(), field, out_.data(), stream_.get());
    staging_.download(closed.data(), out_.data(), words_out * 4);
  }

  /// Uploads the scale and the cubes. It sets `cubes`, which must live as long as the field.
  TileField upload_field(const ScaleLattice& scale, const ClosingParams& params, const VoxelBox& dilated,
                         const TileLayout& layout, CubesOver& cubes) {
    TileField field{scale, nullptr, params.element};
    if (!scale.constant()) field.samples = upload(scale.samples, samples_);
    if (params.turned()) cubes = cubes_over(*params.orientation, dilated);
    if (!cubes.widest.turned) return field;
    field.cubes = &cubes;
    field.cubes_there = view_of(cubes, layout, scale);
    field.cubes_there.rotations = upload(cubes.rotations, rotations_);
    field.cubes_there.cells = upload(cubes.cells, rotation_of_cell_);
    return field;
  }

  template <class T>
  const T* upload(const std::vector<T>& from, DeviceBuffer<T>& to) {
    staging_.upload(to.grow(from.size()), from.data(), from.size() * sizeof(T));
    return to.data();
  }

  static bool whole_bricks(const VoxelBox& box) { return !box.empty() && voxels_of(bricks_of(box)) == box; }

  /// Closes bricks. Only bricks that are neither empty nor full travel, in both directions.
  void close_bricks(const BrickShelf& solid, const BrickBox& bricks, const ScaleLattice& scale, const Halo& halo,
                    const ClosingParams& params, const VoxelBox& interior, BitBox& closed) {
    const BrickBox seen = intersect(bricks_of(interior.grown(halo.total_vox())), bricks), made = bricks_of(interior);
    if (seen.empty()) return closed.reset(interior);
    const TileLayout layout = lay_out(voxels_of(seen), scale, halo, interior);
    const BrickTable in = upload_bricks(solid, seen, layout.solid);
    CubesOver cubes;
    const TileField field = upload_field(scale, params, interior.grown(halo.erosion_vox), layout, cubes);
    const std::size_t n = volume(made);
    BrickTable out = table_of(made, layout.closed);
    out.bits = reinterpret_cast<std::uint64_t*>(out_.grow(n * kBrickWords * 2));
    out.slots = out_slots_.grow(n + 1);
    closing_.enqueue(layout, in, field, out, out.slots + n, stream_.get());
    slots_.resize(n + 1);
    staging_.download(slots_.data(), out.slots, (n + 1) * sizeof(std::uint32_t));
    closed.reset(interior);
    take_bricks(made, out.bits, closed);
  }

  static std::size_t volume(const BrickBox& box) {
    return std::size_t(box.size().x) * std::size_t(box.size().y) * std::size_t(box.size().z);
  }
  static BrickCoord brick_at(const BrickBox& box, std::size_t i) {
    const auto nx = std::size_t(box.size().x), ny = std::size_t(box.size().y);
    return {box.min.x + std::int32_t(i % nx), box.min.y + std::int32_t(i / nx % ny),
            box.min.z + std::int32_t(i / nx / ny)};
  }
  static BrickTable table_of(const BrickBox& box, const BoxOfWords& where) {
    BrickTable t;
    t.nx = box.size().x, t.ny = box.size().y, t.nz = box.size().z;
    t.w0 = where.w0, t.y0 = where.y0, t.z0 = where.z0;
    return t;
  }

  BrickTable upload_bricks(const BrickShelf& solid, const BrickBox& seen, const BoxOfWords& where) {
    const std::size_t n = volume(seen);
    slots_.assign(n, kEmptyBrick);
    std::size_t at = 0, mixed = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const BrickFill fill = solid.fill(brick_at(seen, i));
      if (fill == BrickFill::full) slots_[i] = kFullBrick;
      if (fill == BrickFill::mixed) slots_[i] = std::uint32_t(mixed++);
    }
    BrickTable table = table_of(seen, where);
    table.bits = reinterpret_cast<std::uint64_t*>(in_.grow(n * kBrickWords * 2));
    table.slots = in_slots_.grow(n);
    staging_.upload_pieces(table.bits, kBrickWords * 8, mixed, [&](std::byte* piece) {
      while (at < n && slots_[at] >= kFullBrick) ++at;
      if (at == n) return false;
      (void)solid.get(brick_at(seen, at++), *new (piece) BrickBits);
      return true;
    });
    staging_.upload(table.slots, slots_.data(), n * sizeof(std::uint32_t));
    return table;
  }

  /// Puts the bricks of `made` into `closed`, which is empty. slots_ says where each brick is.
  void take_bricks(const BrickBox& made, const std::uint64_t* bits, BitBox& closed) {
    const std::size_t n = slots_.size() - 1, mixed = slots_[n];
    std::vector<std::size_t> brick_of(mixed);
    for (std::size_t i = 0; i < n; ++i) {
      if (slots_[i] < kFullBrick) brick_of[slots_[i]] = i;
      if (slots_[i] == kFullBrick) put_brick(brick_at(made, i), nullptr, closed);
    }
    staging_.download_blocks(
        bits, mixed * kBrickWords * 8, [&](std::size_t first, const std::byte* block, std::size_t bytes) {
          for (std::size_t at = 0; at < bytes; at += kBrickWords * 8)
            put_brick(brick_at(made, brick_of[(first + at) / (kBrickWords * 8)]), block + at, closed);
        });
  }

  /// Puts one brick into `closed`. `rows`: words of the brick; null: all ones.
  static void put_brick(BrickCoord brick, const std::byte* rows, BitBox& closed) {
    const VoxelCoord first = first_voxel(brick);
    const std::int32_t column = (first.x - closed.box().min.x) / kBrickEdge;
    for (std::int32_t z = 0; z < kBrickEdge; ++z) {
      for (std::int32_t y = 0; y < kBrickEdge; ++y) {
        std::uint64_t word = ~std::uint64_t(0);
        if (rows != nullptr) std::memcpy(&word, rows + 8 * (z * kBrickEdge + y), 8);
        closed.row(first.y + y, first.z + z)[column] = word;
      }
    }
  }

  /// Frees all device memory.
  void make_room() {
    BP_CUDA_CHECK(cudaStreamSynchronize(stream_.get()));
    closing_.release();
    voxelizer_.release();
    winding_.release();
    weighing_.release();
    for (auto* b : {&in_, &out_, &in_slots_, &out_slots_, &skip_, &count_}) b->release();
    samples_.release(), rotations_.release(), rotation_of_cell_.release();
    triangles_.release();
    crossings_.release();
    numbers_.release();
  }

  /// Returns the longest axis along which a tile can be divided into two parts that are closed separately; -1 if there
  /// is none.
  static int longest_divisible_axis(const VoxelBox& tile) {
    int axis = -1;
    for (int i = 0; i < 3; ++i) {
      const bool divisible = tile.size()[i] >= 2 * (i == 0 ? kBrickEdge : kUnit);
      if (divisible && (axis < 0 || tile.size()[i] >= tile.size()[axis])) axis = i;
    }
    return axis;
  }

  /// Closes a tile that is too large for the device: each half of the interior with the part of the solid that it
  /// needs.
  void close_in_halves(const BitBox& solid, const ScaleLattice& scale, const Halo& halo, const ClosingParams& params,
                       const VoxelBox& interior, BitBox& closed) {
    make_room();
    VoxelBox lower = interior, upper = interior;
    const int axis = longest_divisible_axis(interior);
    if (axis < 0) {
      throw DeviceError(fmt::format("{}: not enough device memory for a tile of {} x {} x {} voxels", name_,
                                    interior.size().x, interior.size().y, interior.size().z));
    }
    const std::int32_t unit = axis == 0 ? kBrickEdge : kUnit;  // along x whole words are needed
    lower.max[axis] = upper.min[axis] = floor_div(interior.min[axis] + (interior.size()[axis] + unit) / 2, unit) * unit;
    for (const VoxelBox& half : {lower, upper}) {
      BitBox part_solid(intersect(half.grown(halo.total_vox()), solid.box())), part_closed;
      copy_voxels(solid, part_solid);
      close(part_solid, scale, halo, params, half, part_closed);
      copy_voxels(part_closed, closed);
    }
  }

  Stream stream_;
  cudaDeviceProp properties_;
  std::string name_;
  Staging staging_;
  DeviceClosing closing_;
  DeviceVoxelizer voxelizer_;
  DeviceWinding winding_;
  DeviceWeighing weighing_;
  DeviceBuffer<std::uint32_t> in_, out_, in_slots_, out_slots_, skip_, count_;
  std::vector<std::uint32_t> slots_;
  DeviceBuffer<Scale> samples_;
  DeviceBuffer<Rotation> rotations_;
  DeviceBuffer<std::uint16_t> rotation_of_cell_;
  DeviceBuffer<FixedTriangle> triangles_;
  DeviceBuffer<Crossing> crossings_;
  DeviceBuffer<std::int32_t> numbers_;
};

}  // namespace

std::unique_ptr<Backend> make_cuda_backend(int device) {
  return std::make_unique<CudaBackend>(device);
}

}  // namespace bp
