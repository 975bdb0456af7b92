#!/usr/bin/env bash
# Runs the command in /bdpt as if on old and small machines, where it works or says why not.
set -euo pipefail
render=(/bdpt/bin/bdpt render /scenes/cornell-box.gltf --size 16x16 --spp 1 --quiet)

# Processors without AVX, and without SSE 4.2.
for processor in Nehalem:sse4.2 Conroe:sse2; do
  qemu-x86_64 -cpu "${processor%:*}" "${render[@]}" -o /out/old.exr --stats /out/old.json
  grep -q "\"isa\": *\"${processor#*:}\"" /out/old.json
done

# A folder of settings that nobody may write.
mkdir -p /out/home
chmod 555 /out/home
HOME=/out/home "${render[@]}" -o /out/home.exr

# 512 MB of address space.
code=0
(ulimit -v 524288 && "${render[@]}" -o /out/small.exr) 2>/out/small.txt || code=$?
cat /out/small.txt
[[ $code == 0 || $(wc -l </out/small.txt) -ge 1 ]] && [[ $code -lt 128 ]]
