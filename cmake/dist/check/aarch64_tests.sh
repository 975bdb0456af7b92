#!/usr/bin/env bash
# Builds the unit tests of the core for aarch64 where the archive was built, and runs those of its lower layers under
# qemu: aarch64_tests.sh SOURCE JOBS. The renders of higher ones would take an hour, and tests of lib/io start other
# programs, which qemu does not emulate.
set -euo pipefail
cd "$1"
cmake --preset aarch64 -DBDPT_BUILD_TESTS=ON
cmake --build --preset aarch64 --parallel "$2" --target bdpt_unit_tests
# Catch2 can name tests by the files that they are in.
tests=$(cd tests/unit && find math memory texture film camera geometry material light scene path -name '*_test.cpp' \
  -printf '[#%f]~[long],' | sed 's/\.cpp//g')
time qemu-aarch64 -L /sysroot build/aarch64/tests/unit/bdpt_unit_tests --filenames-as-tags "${tests%,}"
