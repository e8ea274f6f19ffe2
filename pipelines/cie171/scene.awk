# Turns a list of plane objects into a glTF scene. All lengths are in metres. Blanks separate the fields:
#   matte NAME REFLECTANCE                                        a material that reflects diffusely
#   glow NAME EXITANCE                                            a black material that emits light diffusely, lm/m2
#   pane NAME JSON                                                the material of a thin pane; the JSON is its extras.phos
#   wall NAME MATERIAL X Y Z X Y Z X Y Z [hole U0 U1 V0 V1]       a rectangle: corner, two edges, and a hole in metres along the edges
#   lamp NAME CANDELA X Y Z                                       a point with the same intensity in all directions
#   camera NAME X Y Z X Y Z X Y Z WIDTH HEIGHT                    an orthographic camera: place, direction to its right, direction up, size
# The front of a wall faces along the cross product of its edges. A wall that glows shines from its front alone.
BEGIN { pi = atan2(0, -1) }

function number(x) { return sprintf("%.9g", x) }

# Adds a node. Four vectors give its x, y and z axes and its place.
function node(name, x1, x2, x3, y1, y2, y3, z1, z2, z3, p1, p2, p3, what) {
  nodes = nodes (nodes == "" ? "" : ",\n    ") "{\"name\": \"" name "\", \"matrix\": [" number(x1) "," number(x2) "," number(x3) ",0, " \
    number(y1) "," number(y2) "," number(y3) ",0, " number(z1) "," number(z2) "," number(z3) ",0, " \
    number(p1) "," number(p2) "," number(p3) ",1], " what "}"
  all = all (count++ ? "," : "") count - 1
}

# Adds the part of a wall from u0 to u1 along its first edge and from v0 to v1 along its second, as shares of the edges.
function piece(u0, u1, v0, v1,    e, f, n, length_n, i) {
  if (u1 - u0 < 1e-9 || v1 - v0 < 1e-9) return
  for (i = 1; i <= 3; ++i) { e[i] = $(6 + i) * (u1 - u0); f[i] = $(9 + i) * (v1 - v0) }
  n[1] = e[2] * f[3] - e[3] * f[2]; n[2] = e[3] * f[1] - e[1] * f[3]; n[3] = e[1] * f[2] - e[2] * f[1]
  length_n = sqrt(n[1] ^ 2 + n[2] ^ 2 + n[3] ^ 2)
  node($2, e[1], e[2], e[3], f[1], f[2], f[3], n[1] / length_n, n[2] / length_n, n[3] / length_n,
       $4 + u0 * $7 + v0 * $10, $5 + u0 * $8 + v0 * $11, $6 + u0 * $9 + v0 * $12, "\"mesh\": " material[$3])
}

function add_material(json) {
  material[$2] = number_of_materials++
  materials = materials (materials == "" ? "" : ",\n    ") "{\"name\": \"" $2 "\", " json "}"
  meshes = meshes (meshes == "" ? "" : ",\n    ") "{\"name\": \"square of " $2 "\", \"primitives\": [{\"attributes\": {\"POSITION\": 0}, " \
    "\"indices\": 1, \"material\": " material[$2] "}]}"
}

function lambert(reflectance) {
  return "\"extras\": {\"phos\": {\"brdf\": \"lambert\", \"kd\": [" reflectance "," reflectance "," reflectance "]}}"
}

$1 == "matte" { add_material(lambert($3)) }
$1 == "glow" {
  add_material("\"emissiveFactor\": [1,1,1], \"extensions\": {\"KHR_materials_emissive_strength\": {\"emissiveStrength\": " \
    number($3 / pi) "}}, " lambert(0))
}
$1 == "pane" { json = $0; sub(/^pane +[^ ]+ +/, "", json); add_material("\"extras\": {\"phos\": " json "}") }
$1 == "wall" && NF == 12 { piece(0, 1, 0, 1) }
$1 == "wall" && NF > 12 {
  width = sqrt($7 ^ 2 + $8 ^ 2 + $9 ^ 2); height = sqrt($10 ^ 2 + $11 ^ 2 + $12 ^ 2)
  u0 = $14 / width; u1 = $15 / width; v0 = $16 / height; v1 = $17 / height
  piece(0, 1, 0, v0); piece(0, u0, v0, v1); piece(u1, 1, v0, v1); piece(0, 1, v1, 1)
}
$1 == "lamp" {
  lights = lights (lights == "" ? "" : ", ") "{\"type\": \"point\", \"name\": \"" $2 "\", \"intensity\": " number($3) "}"
  node($2, 1, 0, 0, 0, 1, 0, 0, 0, 1, $4, $5, $6, "\"extensions\": {\"KHR_lights_punctual\": {\"light\": " number_of_lights++ "}}")
}
$1 == "camera" {
  cameras = cameras (cameras == "" ? "" : ",\n    ") "{\"name\": \"" $2 "\", \"type\": \"orthographic\", \"orthographic\": {\"xmag\": " \
    number($12 / 2) ", \"ymag\": " number($13 / 2) ", \"znear\": 0, \"zfar\": 1000}}"
  node($2, $6, $7, $8, $9, $10, $11, $7 * $11 - $8 * $10, $8 * $9 - $6 * $11, $6 * $10 - $7 * $9, $3, $4, $5,
       "\"camera\": " number_of_cameras++)
}
END {
  print "{\n  \"asset\": {\"version\": \"2.0\", \"generator\": \"phos, pipelines/cie171.sh\"},"
  print "  \"extensionsUsed\": [\"KHR_materials_emissive_strength\", \"KHR_lights_punctual\"],"
  print "  \"scene\": 0,\n  \"scenes\": [{\"nodes\": [" all "]}],"
  print "  \"nodes\": [\n    " nodes "],"
  print "  \"materials\": [\n    " materials "],"
  print "  \"meshes\": [\n    " meshes "],"
  if (lights != "") print "  \"extensions\": {\"KHR_lights_punctual\": {\"lights\": [" lights "]}},"
  if (cameras != "") print "  \"cameras\": [\n    " cameras "],"
  # A square of 1 m: four corners as 32-bit floats, two triangles as 16-bit numbers.
  print "  \"buffers\": [{\"byteLength\": 60, \"uri\": \"data:application/octet-stream;base64," \
    "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAgD8AAAAAAAAAAAAAgD8AAAAAAAABAAIAAAACAAMA\"}],"
  print "  \"bufferViews\": [{\"buffer\": 0, \"byteLength\": 48}, {\"buffer\": 0, \"byteOffset\": 48, \"byteLength\": 12}],"
  print "  \"accessors\": [\n    {\"bufferView\": 0, \"componentType\": 5126, \"count\": 4, \"type\": \"VEC3\", \"min\": [0,0,0], \"max\": [1,1,0]},"
  print "    {\"bufferView\": 1, \"componentType\": 5123, \"count\": 6, \"type\": \"SCALAR\"}]\n}"
}
