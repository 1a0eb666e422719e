#pragma once

/// BP_CLONES makes the compiler emit an AVX2 version of a function in addition to the baseline, and choose at load
/// time. BP_WIDE_CLONES adds one for AVX-512. The results are the same to the bit, since products and sums are not
/// contracted. Functions that such a function calls must be BP_INLINE. Sanitizer builds have the baseline only, because
/// the choice runs before their runtimes are up.
#if defined(__x86_64__) && defined(__GNUC__) && defined(__gnu_linux__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__) && !defined(__clang__)
#define BP_CLONES __attribute__((target_clones("avx2", "default")))
#define BP_WIDE_CLONES __attribute__((target_clones("arch=x86-64-v4", "avx2", "default")))
#else
#define BP_CLONES
#define BP_WIDE_CLONES
#endif
#define BP_INLINE inline __attribute__((always_inline))
