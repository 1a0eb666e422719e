#pragma once

/// BP_CLONES has the compiler emit an AVX2 version of a function beside the baseline and choose at load time;
/// BP_WIDE_CLONES one for AVX-512, too. The results are the same to the bit, since products and sums are not
/// contracted. What the function calls must be BP_INLINE. Sanitizer builds take the baseline only: the choice runs
/// before their runtimes are up.
#if defined(__x86_64__) && defined(__GNUC__) && defined(__gnu_linux__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__) && !defined(__clang__)
#define BP_CLONES __attribute__((target_clones("avx2", "default")))
#define BP_WIDE_CLONES __attribute__((target_clones("arch=x86-64-v4", "avx2", "default")))
#else
#define BP_CLONES
#define BP_WIDE_CLONES
#endif
#define BP_INLINE inline __attribute__((always_inline))
