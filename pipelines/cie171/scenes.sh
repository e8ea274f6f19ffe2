# Functions that cie171.sh sources: the scenes of CIE 171:2006 and their sensors. Lengths are in metres; X is east, Y up, Z south. The room is
# 4 x 3 x 4 m and black. scene_CASE VARIANT SKY prints a scene for scene.awk, and points_CASE VARIANT SKY prints sensors for phos-sense.

# The walls reflect almost nothing, but not nothing: pictures have no illuminance on a surface without reflectance.
black() { echo 'matte black 1e-12'; }
# room CEILING_HOLE SOUTH_HOLE: the six walls of the room. A hole is "U0 U1 V0 V1" or empty.
room() {
  black
  echo "wall floor black    0 0 0  0 0 4  4 0 0
wall ceiling black  0 3 0  4 0 0  0 0 4 ${1:+hole $1}
wall north black    0 0 0  4 0 0  0 3 0
wall south black    0 0 4  0 3 0  4 0 0 ${2:+hole $2}
wall west black     0 0 0  0 3 0  0 0 4
wall east black     4 0 0  0 0 4  0 3 0"
}
# Cameras that look straight at the lines of sensors, over a width of 0.1 m. Case 5.2 has a wider camera of its own, as its sensors are no line. All
# pixels are 20 mm wide.
cameras() {
  echo "camera north  2 1.5 1.5  1 0 0  0 1 0  0.1 3
camera floor    2 1.5 2    1 0 0  0 0 -1  0.1 4
camera ceiling  2 1.5 2    1 0 0  0 0 1   0.1 4"
}
# pane_of_6mm: the pane of 5.10 and 5.12, glass of 6 mm as measured by Tregenza and Sharples (CIE 171, equation 19). pane_by_schlick: a pane of 5.5, one
# surface by the formula of Schlick.
pane_of_6mm() { curve_pane 6mm '-.028378+3.156075*c-3.058376*c^2-1.428919*c^3+4.014235*c^4-1.775827*c^5'; }
pane_by_schlick() { curve_pane schlick '.96*(1-(1-c)^5)'; }
# curve_pane NAME FORMULA: a pane whose transmittance is given for every degree of the angle of incidence. c is the cosine of this angle.
curve_pane() {
  awk -v name="$1" "BEGIN {
    printf \"pane %s {\\\"brdf\\\": \\\"thindielectric\\\", \\\"transmittance_by_angle\\\": [\", name
    for (a = 0; a <= 90; ++a) {
      c = a < 90 ? cos(a * atan2(0, -1) / 180) : 0; t = $2
      printf \"%s[%d,%.7f]\", (a > 0 ? \",\" : \"\"), a, (t > 0 ? t : 0)
    }
    print \"]}\"
  }"
}

# Sensors: id,x,y,z,nx,ny,nz.
# line "NAMES" "x,y,z" START NORMAL [STEP]: a sensor for each name. The coordinate @ starts at START and grows by STEP (0.5) from name to name.
line() {
  local at=$3 name
  for name in $1; do
    echo "$name,${2/@/$at},$4"
    at=$(awk -v a="$at" -v b="${5:-0.5}" 'BEGIN { print a + b }')
  done
}
wall_points() { line 'A B C D E F' '2,@,0' 2.75 0,0,1 -0.5; }
floor_points() { line "${1:-G H I J K L M N}" '2,0,@' 0.25 0,1,0; }
ceiling_points() { line "$1" '2,3,@' 0.25 0,-1,0; }
# face NAME CORNER EDGE EDGE NORMAL WEIGHT: 8 x 8 sensors NAME@SHARE on a wall, at the points of Gauss-Legendre quadrature. The shares add up to WEIGHT.
face() {
  awk -v name="$1" -v corner="$2" -v e="$3" -v f="$4" -v normal="$5" -v all="$6" 'BEGIN {
    n = split("-.9602898565 -.7966664774 -.5255324099 -.1834346425 .1834346425 .5255324099 .7966664774 .9602898565", at, " ")
    split(".1012285363 .2223810345 .3137066459 .3626837834 .3626837834 .3137066459 .2223810345 .1012285363", weight, " ")
    split(corner, p, ","); split(e, a, ","); split(f, b, ",")
    for (i = 1; i <= n; ++i) for (k = 1; k <= n; ++k) {
      u = (1 + at[i]) / 2; v = (1 + at[k]) / 2
      printf "%s@%.9g,%.9g,%.9g,%.9g,%s\n", name, all * weight[i] * weight[k] / 4, p[1] + a[1] * u + b[1] * v,
        p[2] + a[2] * u + b[2] * v, p[3] + a[3] * u + b[3] * v, normal
    }
  }'
}

# 5.2: a point source whose intensity is 1000 cd downwards and falls as the cosine: a panel of 1 cm^2 in the ceiling.
scene_5.2() { room '' ''; echo "camera floor 2.75 1.5 2.75  1 0 0  0 0 -1  1.66 1.66"; echo "glow lamp 31415926.5
wall lamp lamp  1.995 2.99999 1.995  0.01 0 0  0 0 0.01"; }
points_5.2() { echo 'A,2,0,2
B,2.5,0,2
C,3,0,2
D,3.5,0,2
E,2.5,0,2.5
F,3,0,2.5
G,3.5,0,2.5
H,3,0,3
I,3.5,0,3
J,3.5,0,3.5' | sed 's/$/,0,1,0/'; }

# 5.3: a panel of 1 m^2 in the ceiling, 1000 cd/m^2.
scene_5.3() { room '' ''; cameras; echo "glow panel 3141.59265
wall panel panel  1.5 2.9999 1.5  1 0 0  0 0 1"; }
points_5.3() { wall_points; floor_points; }

# 5.4: a lamp of 10,000 lm in the middle, equal in all directions. The values are the luminous flux on each surface.
scene_5.4() { room '' ''; echo "lamp middle 795.774715 2 1.5 2"; }
points_5.4() {
  face floor 0,0,0 4,0,0 0,0,4 0,1,0 16
  face ceiling 0,3,0 4,0,0 0,0,4 0,-1,0 16
  face north 0,0,0 4,0,0 0,3,0 0,0,1 12
  face south 0,0,4 4,0,0 0,3,0 0,0,-1 12
  face west 0,0,0 0,3,0 0,0,4 1,0,0 12
  face east 4,0,0 0,3,0 0,0,4 -1,0,0 12
}

# 5.5: the transmittance of a pane by angle. A beam of 1000 lx passes the pane and falls on a sensor that faces the beam. The options of the sun hold
# the angle.
scene_5.5() {
  local pane=clear
  case $1 in
    schlick*) pane=schlick; pane_by_schlick ;;
    tregenza*) pane=6mm; pane_of_6mm ;;
    *) echo 'pane clear {"brdf": "thindielectric", "ior": 1.52}' ;;
  esac
  black
  echo "wall floor black  -5 0 -5  0 0 10  10 0 0
wall pane $pane   -5 0.1 -5  0 0 10  10 0 0"
}
points_5.5() { awk -v a="$2" 'BEGIN { r = a * atan2(0, -1) / 180; printf "%s,0,0.01,0,0,%.9g,%.9g\n", a, cos(r), sin(r) }'; }

# 5.6: a diffuse square on the ground that emits 100 lm/m^2, so that the illuminance is the configuration factor in percent.
scene_5.6() {
  awk -v s="$1" 'BEGIN { print "glow square 100"; print "wall square square", 2 - s / 2, 0, 2 - s / 2, 0, 0, s, s, 0, 0 }'
  # No wall may hide a part of the square of 500 m.
  [[ $1 == 500 ]] || { black; echo "wall north black    0 0 0  4 0 0  0 3 0
wall ceiling black  0 3 0  4 0 0  0 0 4"; }
  cameras
}
points_5.6() { line 'A B C D E F' '2,@,0' 0.25 0,0,1; ceiling_points 'G H I J K L M N'; }

# 5.7: a box before the south wall. The wall emits 100 lm/m^2.
scene_5.7() {
  room '' '0 3 0 4'
  echo "glow south 100
wall south south    0 0 4  0 3 0  4 0 0
wall front black    0 0 2.5  0 1 0  4 0 0
wall top black      0 1 2.5  0 0 0.2  4 0 0
wall back black     0 0 2.7  4 0 0  0 1 0"
  cameras
}
points_5.7() { wall_points; floor_points 'G H I J K'; }

# 5.8: a cube of 4 m with a lamp of 10,000 lm in its middle. The values are means over one face, which by symmetry are means over all faces.
scene_5.8() { echo "matte grey $1
lamp middle 795.774715 2 2 2
wall floor grey    0 0 0  0 0 4  4 0 0
wall ceiling grey  0 4 0  4 0 0  0 0 4
wall north grey    0 0 0  4 0 0  0 4 0
wall south grey    0 0 4  0 4 0  4 0 0
wall west grey     0 0 0  0 4 0  0 0 4
wall east grey     4 0 0  0 0 4  0 4 0"; }
points_5.8() { face mean 0,0,0 4,0,0 0,0,4 0,1,0 1; }

# 5.9: an opening in the roof. 5.10: the same with glass in the opening.
roof_hole() { case $1 in 1x1) echo '1.5 2.5 1.5 2.5' ;; 4x4) echo '0 4 0 4' ;; esac; }
scene_5.9() { room "$(roof_hole "$1")" ''; cameras; }
scene_5.10() {
  scene_5.9 "$1"
  pane_of_6mm
  case $1 in 1x1) echo 'wall glass 6mm  1.5 3 1.5  1 0 0  0 0 1' ;; 4x4) echo 'wall glass 6mm  0 3 0  4 0 0  0 0 4' ;; esac
}
points_5.9() { wall_points; floor_points; }
points_5.10() { points_5.9; }

# 5.11: an opening in the south wall. 5.12: the same with glass in the opening. The ground reflects as far as the horizon (--ground-albedo).
scene_5.11() { room '' "$(case $1 in 2x1) echo '1 2 1 3' ;; 4x3) echo '0 3 0 4' ;; esac)"; cameras; }
scene_5.12() {
  scene_5.11 "$1"
  pane_of_6mm
  case $1 in 2x1) echo 'wall glass 6mm  1 1 4  0 1 0  2 0 0' ;; 4x3) echo 'wall glass 6mm  0 0 4  0 3 0  4 0 0' ;; esac
}
points_5.11() { wall_points; floor_points; ceiling_points "G' H' I' J' K' L' M' N'"; }
points_5.12() { points_5.11; }

# 5.13: the window of 2 m x 1 m with a horizontal mask over it. 5.14: the window with a vertical mask opposite. Here the masks emit the light that masks
# of reflectance 0.5 over a ground of reflectance 0.2 would reflect, without the shade of the building. The masks of the report are endless; the
# floor sees no more of endless masks than of these.
# mask_exitance CASE SKY: the exitance of a mask under a sky of 10,000 lx. Every mask reflects light of the ground. The mask opposite also reflects light
# of the northern sky, whose share is in the data.
mask_exitance() {
  awk -F, -v case_of="$1" -v sky="$2" '$1 == sky { print 10000 * 0.5 * (0.2 / 2 + (case_of == "5.14" ? $2 : 0)) }' "$data/vertical_north.csv"
}
scene_5.13() {
  scene_5.11 2x1
  echo "glow mask $(mask_exitance 5.13 "$2")
wall mask mask  -7 3 4  18 0 0  0 0 ${1#mask }"
}
scene_5.14() {
  scene_5.11 2x1
  echo "glow mask $(mask_exitance 5.14 "$2")
wall mask mask  -23 0 10  0 ${1#mask } 0  50 0 0"
}
points_5.13() { floor_points 'A B C D E F G H'; }
points_5.14() { points_5.13; }
