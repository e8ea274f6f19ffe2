# For reproduce.sh to source: the scenes of the tables.
data=$(cd "$here/../data" && pwd)
shared=$here/../../shared/scenes

# made NAME: puts the path of a scene made by pipelines/scenes/make.py into `scene`; fails where there is no python3.
made() {
  scene=$folder/scenes/$1.${2:-glb}
  [[ -f $scene ]] || {
    command -v python3 >/dev/null || return 1
    mkdir -p "$folder/scenes"
    python3 -B "$here/scenes/make.py" "$1" "$scene.part.${2:-glb}" >/dev/null && mv "$scene.part.${2:-glb}" "$scene"
  }
}
# shared_scene FILE: puts its path into `scene`; fails, and says so in a row, where it is not.
shared_scene() {
  scene=$shared/$1
  [[ -f $scene ]] || { skipped "$1" "it is not in ../shared/scenes"; return 1; }
}
