#!/usr/bin/env bash
# Builds wheels in a root of Debian: wheels.sh SOURCE OUT JOBS PYTHON.... Each PYTHON has scikit-build-core and nanobind;
# from 3.12 on, the wheel is for all later ones, too. All share one build folder, so only the module is compiled again.
# /venv has auditwheel, which puts the libraries of others into the wheels. TIFF images are not read (with them a wheel
# would have 260 libraries).
set -euo pipefail
source=$1 out=$2 jobs=$3
shift 3
[[ ! -d /ktx ]] || export BDPT_KTX=/ktx
export CMAKE_BUILD_PARALLEL_LEVEL=$jobs CXX=clang++-19
cd "$source"
raw=$(mktemp -d)
for python; do
  abi=()
  ! "$python" -c 'import sys; sys.exit(sys.version_info < (3, 12))' || abi=(-C wheel.py-api=cp312)
  "$python" -m pip wheel . --no-index --no-build-isolation --no-deps --no-cache-dir -w "$raw" \
    -C build-dir=build/wheel -C cmake.define.BDPT_WITH_OPENIMAGEIO=OFF "${abi[@]}"
done
mkdir -p "$out"
for wheel in "$raw"/*.whl; do
  PATH=/venv/bin:$PATH auditwheel repair --strip -w "$out" "$wheel"
done
