#!/usr/bin/env bash
# Builds unit tests for aarch64 where the archive was built, and runs them under qemu, a file of tests at a time:
# aarch64_tests.sh SOURCE JOBS. Those of renders would take hours. Where programs start others, qemu stops: tests of that,
# of limits of memory and of OpenImageIO, which the archive lacks, are not run.
set -euo pipefail
cd "$1"
cmake --preset aarch64 -DBDPT_BUILD_TESTS=ON
cmake --build --preset aarch64 --parallel "$2" --target bdpt_unit_tests bdpt_io_tests
logs=$(mktemp -d)

# run_file FILE: runs the tests of tests/unit/FILE; Catch2 can name them by the file that they are in.
run_file() {
  local name binary=tests/unit/bdpt_unit_tests log start=$SECONDS
  name=$(basename "$1" .cpp)
  log=$logs/${1//\//-}
  [[ $1 != io/* ]] || binary=tests/unit/io/bdpt_io_tests
  qemu-aarch64 -L /sysroot "build/aarch64/$binary" --filenames-as-tags \
    "[#$name]~[long]~\"an allocation that fails is told*\"~\"the temporary file is in the same folder*\"" >"$log" 2>&1 ||
    { touch "$logs/failed" && cat "$log"; }
  echo "$1: $((SECONDS - start)) s: $(tail -n 2 "$log" | tr -d '\n')"
}
export -f run_file
export logs
(cd tests/unit && find math memory texture film camera geometry material light scene path io -name '*_test.cpp') |
  grep -v -E '/(against_openimageio|tiff|child_process|ktx2)_test.cpp$' | xargs -P "$2" -I{} bash -c 'run_file {}'
echo "tests passed: $(grep -h -o -E 'in [0-9]+ test cases?' "$logs"/* | awk '{n += $2} END {print n}')"
[[ ! -e $logs/failed ]]
