#!/usr/bin/env bash
# Does the Debian package work? debian.sh BUILD makes it from the build folder BUILD, without building, has lintian look at it, installs
# it into a new Debian, runs programs and a pipeline there, and removes it. The new Debian (mmdebstrap) needs root rights and the mirror
# that apt uses here. Prints what is wrong; exit 1 if anything is, 77 where this machine cannot do it.
set -euo pipefail
umask 022
build=$(cd "$1" && pwd)
skip() { echo "skipped: $*"; exit 77; }
for tool in cpack dpkg-shlibdeps dpkg-scanpackages mmdebstrap lintian; do
  command -v $tool >/dev/null || skip "$tool is not installed; pipelines/install.sh --tests installs it"
done
((EUID == 0)) || skip "a new Debian takes root rights"
# In memory, if there is room for a Debian, it is set up several times as fast.
free=$(df --output=avail -k /dev/shm 2>/dev/null | tail -n 1) || free=0
[[ -n ${TMPDIR:-} ]] || ((${free:-0} < 4000000)) || export TMPDIR=/dev/shm
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
chmod 755 "$scratch" # apt reads there as a user of its own
mapfile -t sources < <(apt-get indextargets --format '$(ORIGIN)|deb $(REPO_URI) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' |
  sed -n 's/^Debian|//p' | sort -u)
((${#sources[@]} > 0)) || skip "apt has no lists of Debian; run apt-get update"
(cd "$scratch" && apt-get download hostname >/dev/null 2>&1) || skip "apt cannot fetch from its mirror; run apt-get update"
failed=0
wrong() { echo "debian.sh: $*" >&2; failed=1; }

# 1. The package.
cpack -G DEB --config "$build/CPackConfig.cmake" -B "$scratch/cpack" >"$scratch/log" 2>&1 || { tail "$scratch/log" >&2; exit 1; }
package=$(echo "$scratch"/cpack/*.deb)
field() { dpkg-deb --field "$package" "$1"; }
echo "$(basename "$package"), $(du -h "$package" | cut -f1)"
[[ $(basename "$package") == "phos_$(field Version)_$(field Architecture).deb" ]] || wrong "its name is not that of its version"
for need in libosmesa6 jq libembree libc6; do
  [[ $(field Depends) == *"$need"* ]] || wrong "it does not depend on $need: $(field Depends)"
done
for aid in libegl1 snakemake slurm-client parallel; do
  [[ $(field Suggests) == *"$aid"* ]] || wrong "it does not suggest $aid: $(field Suggests)"
done
TMPDIR=$scratch lintian --allow-root --fail-on error "$package" >"$scratch/log" 2>/dev/null || wrong "lintian finds errors"
sed 's/^/lintian: /' "$scratch/log"

# 2. Use of it in a new Debian, from another folder than phos lies in; and what its removal leaves.
cat >"$scratch/try.sh" <<'TRY'
set -euo pipefail
mkdir /tmp/elsewhere
cd /tmp/elsewhere
scene=/usr/share/phos/data/cornell-measured.glb
phos-photons $scene --photons 20000 --quiet -o box.photons
phos-irradiance $scene box.photons --quiet -o box.irradiance
phos-splat $scene box.irradiance --splat gl --width 64 --pixel-samples 1 --quiet -o box.exr
/usr/share/phos/pipelines/render.sh $scene out --width 32 --photons 10000 --rays 16 --samples 1 >/dev/null
ls -s box.exr out/*.png
gzip -t /usr/share/man/man1/phos-*.gz /usr/share/doc/phos/changelog.Debian.gz
grep -q Permission /usr/share/doc/phos/copyright
dpkg-query --listfiles phos >/tmp/files
dpkg --purge phos >/dev/null
while IFS= read -r file; do
  if [[ ! -d $file && -e $file ]]; then echo "left: $file"; fi
done </tmp/files
find / \( -path /proc -o -path /sys -o -path /dev -o -path /tmp -o -path /var/cache/apt -o -path /var/lib/apt \) -prune \
  -o -name '*phos[-.]*' -print -o -name phos -print | sed 's/^/left: /'
echo tried
TRY
mkdir "$scratch/repository"
cp "$package" "$scratch/repository"
(cd "$scratch/repository" && dpkg-scanpackages . >Packages 2>/dev/null)
mmdebstrap --mode=root --variant=essential --format=null --include=phos --dpkgopt=force-unsafe-io \
  --customize-hook="cp '$scratch/try.sh' \"\$1/try.sh\"" --customize-hook='chroot "$1" bash /try.sh' \
  "$(. /etc/os-release && echo "$VERSION_CODENAME")" - "${sources[@]}" "deb [trusted=yes] copy:$scratch/repository ./" \
  >"$scratch/log" 2>&1 || wrong "it does not work in a new Debian"
if grep -q '^left: ' "$scratch/log" || ! grep -qx tried "$scratch/log"; then
  wrong "of its use and removal:"
  tail -n 40 "$scratch/log" >&2
fi
((failed)) || echo "installed, tried and removed without a trace"
exit $failed
