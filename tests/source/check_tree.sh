#!/usr/bin/env bash
# Checks of the sources themselves: check_tree.sh ROOT
#   one name, one type    no two headers of lib define a type of the same name (the one-definition rule)
#   one module, one space a file of lib/x opens the namespace phos::x and no other but for forward declarations; core's types stand in phos
#   header and source      every source of lib has a header of its name beside it, but for those listed below
#   judges apart          lib/reference includes nothing of photons, but for lib/reference/map the photon map itself
#   folders of one idea   no folder of lib holds more than 40 sources
set -euo pipefail
cd "$1"
failed=0

# Types at the scope of a namespace stand in the first column; forward declarations end in a semicolon.
twice=$(find lib -name '*.h' -exec awk '
  /^(struct|class|enum class|enum) [A-Z][A-Za-z0-9_]*/ && !/;[ \t]*$/ {
    if ($0 ~ /^[a-z ]+[A-Za-z0-9_]+::/) next
    name = $1 == "enum" && $2 == "class" ? $3 : $2
    sub(/[^A-Za-z0-9_].*/, "", name)
    print name, FILENAME
  }' {} + | sort | awk '$1 == before { print "  " $1 ": " where ", " $2 } { before = $1; where = $2 }')
if [[ -n $twice ]]; then
  echo "two types of one name:"
  echo "$twice"
  failed=1
fi

# A forward declaration of another module's type stands in that module's namespace, which ends at once.
foreign=$(find lib \( -name '*.h' -o -name '*.cpp' \) -exec awk '
  FNR == 1 { split(FILENAME, part, "/"); module = part[2]; own = module == "core" ? "phos" : "phos::" module }
  /^namespace [a-z_:]+( [a-z_]+)? \{/ {
    name = $0; sub(/^namespace /, "", name); sub(/ \{.*/, "", name); sub(/inline /, "", name)
    if (name == own || index(name, own "::") == 1) next
    opened = name; types = 0; next
  }
  opened != "" && /^(struct|class|enum class) [A-Za-z0-9_ :]+;/ { next }
  opened != "" && /^}/ { opened = ""; next }
  opened != "" { print "  " FILENAME ": " opened; opened = "" }' {} +)
if [[ -n $foreign ]]; then
  echo "files that open another module's namespace:"
  echo "$foreign"
  failed=1
fi

shared=$(grep -rnE '#include "(photon|record|radiance|estimate|place)/' lib/reference | grep -vE '^lib/reference/map/[^:]*:[0-9]+:#include "photon/photon_map.h"' || true)
if [[ -n $shared ]]; then
  echo "estimators that the reference shares with what it judges:"
  echo "$shared"
  failed=1
fi

crowded=$(find lib \( -name '*.h' -o -name '*.cpp' -o -name '*.inc' \) -printf '%h\n' | sort | uniq -c | awk '$1 > 40 { print "  " $2 ": " $1 }')
if [[ -n $crowded ]]; then
  echo "folders of more than 40 sources:"
  echo "$crowded"
  failed=1
fi
# Sources without a header of their own: variants of one header by instruction set, parts of one class, and finalize(),
# which scene/scene.h declares.
headless=$(find lib -name '*.cpp' | sort | while read -r source; do
  [[ -f ${source%.cpp}.h ]] && continue
  case $source in
    *_avx2.cpp | *_plain.cpp) header=${source%_*}.h ;; # variants
    # parts of Tool, Bsdf, MerlBrdf, GlRenderer and FilmMaker
    lib/file/tool_*.cpp | lib/scene/material/bsdf_*.cpp | lib/scene/material/merl_*.cpp | lib/splat/gl/renderer_*.cpp | lib/temporal/film/maker_*.cpp)
      header=${source%_*}.h
      while [[ ! -f $header && ${header%.h} == *_* ]]; do header=${header%_*}.h; done ;; # maker_by_rate.cpp: maker.h
    lib/scene/finalize/finalize.cpp) header=lib/scene/scene.h ;;
    *) header= ;;
  esac
  [[ -n $header && -f $header ]] || echo "  $source"
done)
if [[ -n $headless ]]; then
  echo "sources without a header of the same name:"
  echo "$headless"
  failed=1
fi
exit $failed
