#!/usr/bin/env bash
# bash tests/fuzz/run.sh [seconds]: fuzzes the reading of checkpoints with libFuzzer, AddressSanitizer and UBSan; needs clang.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
out=build/fuzz
mkdir -p "$out/corpus"
hdf5=$(pkg-config --exists hdf5-serial && echo hdf5-serial || echo hdf5)
read -ra flags <<< "$(pkg-config --cflags --libs "$hdf5")"
clang++ -std=c++20 -O1 -gline-tables-only -fno-omit-frame-pointer -march=native -ffp-contract=off -fno-math-errno -fopenmp \
    -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all -Iinclude -isystem /usr/include/eigen3 \
    tests/fuzz/checkpoint.cpp -o "$out/checkpoint" "${flags[@]}"
"$out/checkpoint" -max_total_time="${1:-60}" -max_len=4096 -len_control=0 -artifact_prefix="$out/" -print_final_stats=1 "$out/corpus"
