#!/usr/bin/env bash
# Installs, uses, removes and purges the packages in /packages: debian.sh VERSION
set -euo pipefail
version=$1
export DEBIAN_FRONTEND=noninteractive
list() { find /etc /usr /opt -name '*bdpt*' | sort; }
[[ -z $(list) ]]
dpkg-query -W -f '${Package}\n' | sort >/before
apt-get -qq update
apt-get -qq -y --no-install-recommends install /packages/*.deb >/dev/null
[[ $(bdpt --version | sed -n 1p) == "bdpt $version" ]]
cd /out
bdpt render /scenes/cornell-box.gltf --size 32x32 --spp 1 --quiet --volume /scenes/smoke.vdb -o packages.png
python3 -c 'import bdpt; assert bdpt.render(bdpt.load("/scenes/cornell-box.gltf"), size=(16, 16), spp=1).image.any()'
mapfile -t ours < <(dpkg-query -W -f '${Package}\n' | grep bdpt)
echo "installed: ${ours[*]}"
apt-get -qq -y remove "${ours[@]}" >/dev/null
[[ -z $(list) ]] || { list; exit 1; }
dpkg --purge "${ours[@]}"
apt-get -qq -y --purge autoremove >/dev/null
dpkg-query -W -f '${Package}\n' | sort | diff /before -
