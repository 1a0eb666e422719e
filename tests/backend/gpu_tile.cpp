#include "tests/backend/gpu_tile.h"

namespace bp {

GpuTile::GpuTile(const BitBox& solid, const ScaleLattice& scale, const Halo& halo, const VoxelBox& interior)
    : scale_(scale), interior_(interior), layout_(lay_out(solid.box(), scale, halo, interior)) {
  const std::size_t bytes = std::size_t(solid.word_count()) * 8;
  solid_.grow(bytes / 4);
  samples_.grow(scale.samples.size());
  closed_.grow(std::size_t(BitBox(interior).word_count()) * 2);
  BP_CUDA_CHECK(cudaMemcpyAsync(solid_.data(), solid.data(), bytes, cudaMemcpyHostToDevice, nullptr));
  BP_CUDA_CHECK(cudaMemcpyAsync(samples_.data(), scale.samples.data(), scale.samples.size() * sizeof(Scale),
                                cudaMemcpyHostToDevice, nullptr));
  BP_CUDA_CHECK(cudaDeviceSynchronize());
}

void GpuTile::close(DeviceClosing& closing, StructuringElement element, cudaStream_t stream,
                    const DeviceClosing::Mark& mark) {
  closing.enqueue(layout_, solid_.data(),
                  {scale_, samples_.data(), element, cubes_there_.cells ? &cubes_ : nullptr, cubes_there_},
                  closed_.data(), stream, mark);
}

void GpuTile::close(HierarchicalClosing& closing, StructuringElement element, HierarchicalVariant variant,
                    cudaStream_t stream, const DeviceClosing::Mark& mark) {
  closing.enqueue(layout_, solid_.data(), scale_, samples_.data(), element, variant, closed_.data(), stream, mark,
                  rotations_.cells != nullptr ? &rotations_ : nullptr);
}

void GpuTile::orient(const OrientationField& field, const VoxelBox& region) {
  orient(sample(field, region));
  cubes_ = cubes_over(field, region);
  if (!cubes_.widest.turned) return;
  cubes_there_ = view_of(cubes_, layout_, scale_);
  cubes_there_.rotations = cube_rotations_.grow(cubes_.rotations.size());
  cubes_there_.cells = cube_cells_.grow(cubes_.cells.size());
  BP_CUDA_CHECK(cudaMemcpyAsync(cube_rotations_.data(), cubes_.rotations.data(),
                                cubes_.rotations.size() * sizeof(Rotation), cudaMemcpyHostToDevice, nullptr));
  BP_CUDA_CHECK(cudaMemcpyAsync(cube_cells_.data(), cubes_.cells.data(), cubes_.cells.size() * sizeof(std::uint16_t),
                                cudaMemcpyHostToDevice, nullptr));
  BP_CUDA_CHECK(cudaDeviceSynchronize());
}

void GpuTile::orient(const RotationLattice& rotations) {
  const VoxelCoord n = rotations.size, first = rotations.origin;
  rotations_ = {rotation_cells_.grow(rotations.cells.size()),
                n.x,
                n.y,
                n.z,
                layout_.ox + scale_.origin.x - first.x,
                layout_.oy + scale_.origin.y - first.y,
                layout_.oz + scale_.origin.z - first.z};
  BP_CUDA_CHECK(cudaMemcpyAsync(rotation_cells_.data(), rotations.cells.data(),
                                rotations.cells.size() * sizeof(Rotation), cudaMemcpyHostToDevice, nullptr));
  BP_CUDA_CHECK(cudaDeviceSynchronize());
}

void GpuTile::poison(cudaStream_t stream) {
  BP_CUDA_CHECK(cudaMemsetAsync(closed_.data(), 0x5a, closed_.bytes(), stream));
}

BitBox GpuTile::result(cudaStream_t stream) const {
  BitBox out(interior_);
  BP_CUDA_CHECK(
      cudaMemcpyAsync(out.data(), closed_.data(), std::size_t(out.word_count()) * 8, cudaMemcpyDeviceToHost, stream));
  BP_CUDA_CHECK(cudaStreamSynchronize(stream));
  return out;
}

}  // namespace bp
