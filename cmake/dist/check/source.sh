#!/usr/bin/env bash
# Builds the command from an unpacked source tarball, quickly, and renders: source.sh SOURCE JOBS VERSION COMPILER
set -euo pipefail
cd "$1"
cmake --preset release -DBDPT_BUILD_TESTS=OFF -DCMAKE_CXX_COMPILER="$4" -DCMAKE_CXX_FLAGS_RELEASE=-O0 -DBDPT_LTO=OFF
cmake --build --preset release --parallel "$2"
[[ $(build/release/apps/bdpt --version | sed -n 1p) == "bdpt $3" ]]
build/release/apps/bdpt render scenes/cornell-box.gltf --size 16x16 --spp 1 --quiet -o /tmp/source.png
[[ -s /tmp/source.png ]]
