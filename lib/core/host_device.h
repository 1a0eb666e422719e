#pragma once
/// BP_HD marks the inner steps that host and device share, so that both decide in the same integers.
#ifdef __CUDACC__
#define BP_HD __host__ __device__
#else
#define BP_HD
#endif
