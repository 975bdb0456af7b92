#!/usr/bin/env bash
# Builds the unit tests of the core for aarch64 where the archive was built, and runs them under qemu: aarch64_tests.sh
# SOURCE JOBS. Tests of files start other programs, which qemu does not emulate.
set -euo pipefail
cd "$1"
cmake --preset aarch64 -DBDPT_BUILD_TESTS=ON
cmake --build --preset aarch64 --parallel "$2" --target bdpt_unit_tests
time qemu-aarch64 -L /sysroot build/aarch64/tests/unit/bdpt_unit_tests '~[long]'
