#!/usr/bin/env bash
# Installs the missing ones of the Debian packages that phos is built from.
#   pipelines/install.sh [--tests] [--cluster]      --tests: also the packages that the tests need; --cluster: also those of pipelines/cluster.sh
set -euo pipefail

packages=(g++ cmake ninja-build pkg-config
  libembree-dev libtbb-dev librandom123-dev libcli11-dev nlohmann-json3-dev libxxhash-dev libglm-dev
  libopenexr-dev libpng-dev libtinygltf-dev libtinyobjloader-dev libstb-dev libflann-dev liblz4-dev libdeflate-dev libcgal-dev
  libcairo2-dev fonts-dejavu-core libosmesa6-dev libegl-dev libtomlplusplus-dev libboost-dev libeigen3-dev jq)
for option in "$@"; do
  case $option in
    --tests) packages+=(libgtest-dev libbenchmark-dev man-db dpkg-dev lintian mmdebstrap chromium) ;;
    --cluster) packages+=(snakemake slurm-wlm munge parallel python3 python3-yaml) ;;
    *) echo "install.sh: $option: give --tests or --cluster" >&2; exit 2 ;;
  esac
done

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q '^install ok installed$' || missing+=("$package")
done
if ((${#missing[@]} == 0)); then
  echo "packages: all ${#packages[@]} are installed"
  exit 0
fi
echo "packages: installing ${missing[*]}"
as_root=()
if ((EUID != 0)); then
  command -v sudo >/dev/null || { echo "run as root, or install sudo: apt-get install ${missing[*]}" >&2; exit 3; }
  as_root=(sudo)
fi
export DEBIAN_FRONTEND=noninteractive
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
