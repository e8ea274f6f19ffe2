# Functions that cie171.sh sources. estimate_NAME prints the table id,x,y,z,nx,ny,nz,E_lx,stderr_lx,... for $points in $scene, with ${options[@]}.

sense() { phos-sense "$scene" "$@" "${options[@]}" --points "$points"; }
# Makes records at the points from photons, and removes the photons afterwards.
from_photons() {
  phos-photons "$scene" "${options[@]}" --photons "$photons" -o "$folder/light.photons"
  phos-irradiance "$scene" "$folder/light.photons" "${options[@]}" --at "$points" --place every "$@" -o "$folder/light.irradiance"
  rm "$folder/light.photons"
}
# Makes records at the points from gathered rays. The rays read photons where light is reflected more than once.
from_rays() {
  set -- --estimate gather --rays "$rays" "$@"
  if [[ $case == 5.8 ]]; then
    from_photons "$@"
  else
    phos-irradiance "$scene" "${options[@]}" --gather-bounces 1 --at "$points" --place every "$@" -o "$folder/light.irradiance"
  fi
}

# Path tracing at each point.
estimate_exact() { sense --exact --samples 4000000 --error "$error"; }
# Records of photons for indirect light. Direct light comes from shadow rays. These are the default settings of the programs.
estimate_records() {
  from_photons
  sense "$folder/light.irradiance" --light-samples "$light_samples"
}
# Photons counted about each point, photons of direct light included.
estimate_photons() {
  from_photons --direct cached
  sense "$folder/light.irradiance" --light-samples 0
}
# Gathered rays that read records of photons. Direct light comes from shadow rays.
estimate_gathered() {
  from_rays
  sense "$folder/light.irradiance" --light-samples "$light_samples"
}
# The same with direct light in the records. The records reach only so far that light hardly changes.
estimate_cached() {
  from_rays --direct cached --light-samples "$light_samples" --accuracy 0.05
  sense "$folder/light.irradiance" --light-samples 0
}
# Pixels of pictures that look straight at the points. The value of a point is the mean of the pixels at the point and up to 50 mm beside it along X,
# where light is the same. The standard error comes from the spread of these pixels.
estimate_picture() {
  from_rays
  local camera normal
  : >"$folder/pixels.csv"
  for camera in floor ceiling north; do
    case $camera in floor) normal=0,1,0 ;; ceiling) normal=0,-1,0 ;; north) normal=0,0,1 ;; esac
    grep -q ",$normal\$" "$points" || continue
    phos-splat "$scene" "$folder/light.irradiance" "${options[@]}" --camera $camera --splat cpu --height "$(picture_rows $camera)" \
      --pixel-samples 1 --light-samples "$pixel_samples" --layers illuminance,position -o "$folder/light.exr"
    phos-picture "$folder/light.exr" --layer position --quiet -o "$folder/position.csv"
    phos-picture "$folder/light.exr" --layer illuminance --quiet -o "$folder/lux.csv"
    paste -d, "$folder/position.csv" "$folder/lux.csv" | tail -n +2 >>"$folder/pixels.csv"
  done
  awk -F, 'NR == FNR { x[n] = $3; y[n] = $4; z[n] = $5; lux[n++] = $8; next }
    FNR == 1 { print "id,x,y,z,nx,ny,nz,E_lx,stderr_lx"; next }
    { sum = squares = number = 0
      for (i = 0; i < n; ++i)
        if ((x[i] - $2) ^ 2 < 0.0025 && (y[i] - $3) ^ 2 + (z[i] - $4) ^ 2 < 0.000101) { sum += lux[i]; squares += lux[i] ^ 2; ++number }
      if (number < 2) { print "cie171.sh: no pixel shows " $1 >"/dev/stderr"; exit 3 }
      mean = sum / number; variance = (squares / number - mean ^ 2) / (number - 1)
      print $0 "," mean "," (variance > 0 ? sqrt(variance) : 0) }' "$folder/pixels.csv" "$points"
}
# picture_rows CAMERA: the number of rows of 20 mm over the height that the camera sees.
picture_rows() {
  awk -v name="$1" -F'"' '/"type": "orthographic"/ && $4 == name { match($0, /"ymag": [0-9.]+/)
    printf "%.0f", 2 * substr($0, RSTART + 8, RLENGTH - 8) / 0.02 }' "$scene"
}
