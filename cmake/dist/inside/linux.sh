#!/usr/bin/env bash
# Builds the archive, the Debian packages and the add-on for Blender in a root of Debian: linux.sh SOURCE OUT JOBS.
# /venv has Python's nanobind; /denoiser and /ktx have Open Image Denoise and libktx, if they were fetched.
set -euo pipefail
source=$1 out=$2 jobs=$3
options=()
[[ ! -d /denoiser ]] || options+=(-DBDPT_DENOISER=/denoiser)
[[ ! -d /ktx ]] || options+=(-DBDPT_KTX=/ktx)
cd "$source"
cmake --preset release -DBDPT_BUILD_TESTS=OFF -DCMAKE_CXX_COMPILER=clang++-19 -DBDPT_BUILD_PYTHON=ON \
  -DPython_EXECUTABLE=/venv/bin/python "${options[@]}"
cmake --build --preset release --parallel "$jobs" --target all bdpt_archive
mkdir -p "$out"
cp build/release/bdpt-*-linux-*.tar.xz build/release/apps/bdpt_render-*.zip "$out"
strip-nondeterminism --timestamp "$SOURCE_DATE_EPOCH" "$out"/*.zip
cd build/release
cpack -G DEB -B "$PWD/packages"
cp packages/*.deb "$out"
bash "$source/cmake/dist/inside/compiled_in.sh" "$PWD" >"$out/compiled-in.txt"
