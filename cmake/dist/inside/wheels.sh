#!/usr/bin/env bash
# Builds wheels in a root of Debian: wheels.sh SOURCE OUT JOBS PYTHON.... Each PYTHON has scikit-build-core and nanobind;
# from 3.12 on, the wheel is for all later ones, too. All share one build folder, so only the module is compiled again.
# A PYTHON for aarch64 runs under qemu, and what it builds is compiled against /sysroot.
# /venv has auditwheel, which puts the libraries of others into the wheels. TIFF images are not read (with them a wheel
# would have 260 libraries).
set -euo pipefail
source=$1 out=$2 jobs=$3
shift 3
machine=$("$1" -c 'import platform; print(platform.machine())')
options=(-C "build-dir=build/wheel-$machine" -C cmake.define.BDPT_WITH_OPENIMAGEIO=OFF)
ktx=/ktx
repair=(--strip)
if [[ $machine == aarch64 ]]; then
  options+=(-C cmake.define.BDPT_SYSROOT=/sysroot
    -C "cmake.define.CMAKE_TOOLCHAIN_FILE=$source/cmake/toolchains/aarch64-linux.cmake")
  ktx=/ktx-aarch64
  repair=(--ldpaths /sysroot/usr/lib/aarch64-linux-gnu:/sysroot/lib/aarch64-linux-gnu)
fi
[[ ! -d $ktx ]] || export BDPT_KTX=$ktx
export CMAKE_BUILD_PARALLEL_LEVEL=$jobs CXX=clang++-19 PATH=/venv/bin:$PATH
cd "$source"
raw=$(mktemp -d)
for python; do
  abi=()
  ! "$python" -c 'import sys; sys.exit(sys.version_info < (3, 12))' || abi=(-C wheel.py-api=cp312)
  "$python" -m pip wheel . --no-index --no-build-isolation --no-deps --no-cache-dir -w "$raw" "${options[@]}" "${abi[@]}"
done
mkdir -p "$out"
for wheel in "$raw"/*.whl; do
  auditwheel repair "${repair[@]}" -w "$out" "$wheel"
done
