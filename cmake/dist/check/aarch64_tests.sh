#!/usr/bin/env bash
# Builds the unit tests for aarch64 where the archive was built, and runs them under qemu: aarch64_tests.sh SOURCE JOBS
# TIFF images are left out: their reader is not in the archive either. So are tests that start other programs, which
# qemu does not emulate.
set -euo pipefail
cd "$1"
cmake --preset aarch64 -DBDPT_BUILD_TESTS=ON
cmake --build --preset aarch64 --parallel "$2" --target bdpt_unit_tests bdpt_io_tests bdpt_fake_ktx bdpt_fake_oidn
for program in bdpt_unit_tests bdpt_io_tests; do
  echo "== $program"
  time qemu-aarch64 -L /sysroot "$(find build/aarch64/tests -name "$program" -type f)" '~[long]'
done
