#!/usr/bin/env bash
# Builds the archive for aarch64 in a root of Debian: aarch64.sh SOURCE OUT JOBS. /sysroot has a Debian for arm64,
# /ktx-aarch64 libktx, if it was fetched. There is no Open Image Denoise to fetch.
set -euo pipefail
source=$1 out=$2 jobs=$3
options=()
[[ ! -d /ktx-aarch64 ]] || options+=(-DBDPT_KTX=/ktx-aarch64)
cd "$source"
cmake --preset aarch64 -DBDPT_SYSROOT=/sysroot "${options[@]}"
cmake --build --preset aarch64 --parallel "$jobs" --target bdpt_archive
mkdir -p "$out"
cp build/aarch64/bdpt-*-linux-aarch64.tar.xz "$out"
