#!/usr/bin/env bash
# Finishes a root for another processor: finish_sysroot.sh ROOT. The one that has Draco will be used as /sysroot.
source "$(dirname "${BASH_SOURCE[0]}")/record_packages.sh"
record_packages "$@"
root=$1
find "$root" -type l -lname '/*' ! -path "$root/dev/*" | while read -r link; do
  ln -sfr "$root$(readlink "$link")" "$link"
done
# Draco's package names its files by their absolute paths.
find "$root/usr/lib" -path '*/cmake/draco/*.cmake' -exec sed -i 's|"/usr/|"/sysroot/usr/|g; s|;/usr/|;/sysroot/usr/|g' {} +
