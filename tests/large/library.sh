#!/usr/bin/env bash
# Makes 10,000 random turns (some 70,000 calls) on libbp under address, leak and undefined-behaviour sanitizers: one after the other, and on 8 threads at
# once. Every call must end with a result or a message, and no memory may stay.
#   tests/large/library.sh BUILD [TURNS]      BUILD: a folder that is configured by the preset asan (or tsan); it builds bp_turns there
# Prints a line for each run; exit status 1 if one fails.
set -euo pipefail
build=$1 turns=${2:-10000}
cmake --build "$build" --target bp_turns > /dev/null
export ASAN_OPTIONS=detect_leaks=1:detect_stack_use_after_return=1 UBSAN_OPTIONS=print_stacktrace=1
"$build/tests/api/bp_turns" "$turns" 1
"$build/tests/api/bp_turns" $((turns / 20)) 100000 8
