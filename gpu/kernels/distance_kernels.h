#pragma once
#include <cuda_runtime.h>

#include "gpu/kernels/transform_args.h"

/// The separable transform of a slab, for the voxels that cells left open. value(p) = min over seeds q of |p-q|^2 +
/// offset(q) is computed by three passes over small integers; then value(p) < bound(p) decides.
namespace bp {

void row_pass(const TransformArgs& args, int multiprocessors, cudaStream_t stream);
void y_pass(const TransformArgs& args, int multiprocessors, cudaStream_t stream);
void z_pass(const TransformArgs& args, const DecideArgs& decide, int multiprocessors, cudaStream_t stream);

}  // namespace bp
