#!/usr/bin/env bash
# Makes 10,000 random turns (some 70,000 calls) on libbp under address, leak and undefined-behaviour sanitizers: one after the other, and on 8 threads at
# once. Every call must end with a result or a message, and no memory may stay. Then the Python module, with half as many calls of random arrays and
# arguments on the same library: Python and NumPy bring leaks of their own, so that only wrong accesses count there. With the preset tsan
# there are only the turns on 8 threads at once.
#   tests/large/library.sh BUILD [TURNS]      BUILD: a folder that is configured by the preset asan or tsan; it builds bp_turns there
# Prints what each run did; exit status 1 if one fails. PYTHON: one with NumPy (python3).
set -euo pipefail
build=$1 turns=${2:-10000}
root=$(cd "$(dirname "$0")/../.." && pwd)
cmake --build "$build" --target bp_turns > /dev/null
if grep -q -- '-fsanitize=thread' "$build/CMakeCache.txt"; then
  export TSAN_OPTIONS="suppressions=$root/tests/large/tsan.supp halt_on_error=1 second_deadlock_stack=1"
  exec "$build/tests/api/bp_turns" $((turns / 20)) 100000 8
fi
export ASAN_OPTIONS=detect_leaks=1:detect_stack_use_after_return=1 UBSAN_OPTIONS=print_stacktrace=1
"$build/tests/api/bp_turns" "$turns" 1
"$build/tests/api/bp_turns" $((turns / 20)) 100000 8

library=$(realpath "$build/tools/api/libbp.so.0")
runtimes=$(ldd "$library" | grep -oE '/[^ ]*lib(a|ub|t)san\.[^ ]*' | tr '\n' ' ')
env LD_PRELOAD="$runtimes" ASAN_OPTIONS=detect_leaks=0 PYTHONMALLOC=malloc PYTHONDONTWRITEBYTECODE=1 PYTHONPATH="$root/tools/python" \
  BP_LIBRARY="$library" BP_TURNS=$((turns / 2)) "${PYTHON:-python3}" "$root/tests/api/test_misuse.py"
