# A check of what judges the rest: the mean of a picture by bidirectional paths and by paths from the eye alone, in joint standard errors.
table_two_ways() {
  local entry width=$(pick 128 24) method
  for entry in "$data/cornell-empty.glb" "$data/cornell-measured.glb" "$data/cornell-glossy22.glb" "$data/cube-in-a-box.glb" "$data/spheres.glb" \
    "$shared/sponza-flat.glb" "$shared/mcguire-cornellbox-sphere.glb" "$shared/veach-bidir.glb"; do
    if [[ $entry == "$shared"/* ]]; then
      [[ $size == full ]] || continue
      shared_scene "${entry##*/}" || continue
    fi
    for method in path bidirectional; do
      phos-reference "$entry" --method "$method" --width "$width" --samples "$(pick 512 16)" "${common[@]}" --reuse -o "$work/$method.exr"
      phos-picture "$work/$method.exr" --layer beauty --quiet -o "$work/$method-light.csv"
      phos-picture "$work/$method.exr" --layer stderr --quiet -o "$work/$method-stderr.csv"
    done
    # Layers of one or three components after x and y; luminance of three.
    paste -d, "$work"/path-light.csv "$work"/path-stderr.csv "$work"/bidirectional-light.csv "$work"/bidirectional-stderr.csv |
      awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "x") at[++layers] = i; at[layers + 1] = NF + 1; next }
        { for (k = 1; k <= 4; ++k) { first = at[k] + 2; n = at[k + 1] - first
            v = n >= 3 ? 0.2126 * $first + 0.7152 * $(first + 1) + 0.0722 * $(first + 2) : $first
            if (k % 2) sum[k] += v; else squares += v * v } }
        END { n = NR - 1; s = sqrt(squares) / n; d = (sum[3] - sum[1]) / n; if (s > 0) printf "%.2f %.3f\n", d / s, 100 * d / (sum[1] / n); else print "0 0" }' >"$work/difference.txt"
    local sigma share
    read -r sigma share <"$work/difference.txt"
    claimed "$(basename "$entry" .glb): bidirectional minus path" 'none (within 3 standard errors)' "$sigma standard errors, $share %" \
      "$sigma > -3 && $sigma < 3" 'mean luminance of the picture'
  done
  rm -f "$work"/*.csv "$work"/*.txt
}
