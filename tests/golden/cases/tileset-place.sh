# Tilesets on the globe: a model at a place, and a map by its system; what bpcheck says of them, and of what was changed.
write_cube house.obj 12
awk '/^v/ { print "v", $2 + 593000, $3 + 5763000, $4; next } { print }' house.obj > map.obj
made() { bplod "$@" --profile 3dtiles --voxel 1 -j 1 --overwrite > list; }
# at_origin FOLDER: the root's origin in ECEF coordinates, and as the tileset has it.
at_origin() {
  python3 - "$1" << 'PY'
import json, sys
t = json.load(open(sys.argv[1] + "/tileset.json"))
print(*("%.3f" % x for x in t["root"]["transform"][12:15]), {k: v for k, v in t["asset"]["extras"]["placement"].items() if k != "operation"})
PY
}
try made house.obj --place 4.36,52.01,43 -q -o house
at_origin house
try bpcheck house.obj house
bpinfo house | grep '^place'
try made map.obj --up z --place 4.36,52.01,43 --origin 593000,5763000,0 -q -o point
try bpcheck map.obj point | tail -1
try made map.obj --up z --place 4.36,52.01,43 -o far 2>&1 | grep 'falls'
# As a scene it is where its scene is, and a note says that its place is lost. Its contents claim something.
try bpcheck --claimed house.obj house
try bpcheck --claimed house
bpvox house --voxel 1 --up y -o again.bpv && bpinfo again.bpv | grep '^scene '

if said 'made map.obj --crs EPSG:32631 -o map' > system && ! grep -q 'no PROJ' system; then
  grep 'EPSG\|^=\|prove' system | sed 's/takes ".*"/takes OPERATION/'
  at_origin map
  try bpcheck map.obj map
  bpcheck map.obj map --json | grep -A8 '"placement"'
  try bpcheck house.obj map | grep ' content,\|^='
  sed -i 's/"operation": ".*"/"operation": "another"/' map/tileset.json
  try bpcheck map.obj map | sed 's/takes ".*" here/takes OPERATION here/'
  try made map.obj --crs EPSG:1 -q -o x
  try made map.obj --crs EPSG:4326 -q -o x
  try made map.obj --up y --crs EPSG:32631 -q -o x
else
  echo 'skipped: this build has no PROJ'
  exit 77
fi

# Moved by hand: by a millimetre and more the place is no longer that of the file.
move() {
  python3 - "$1" << 'PY'
import json, sys
t = json.load(open("house/tileset.json"))
t["root"]["transform"][14] += float(sys.argv[1])
json.dump(t, open("house/tileset.json", "w"))
PY
}
move 0.0005
try bpcheck house.obj house | tail -1
move 0.001
try bpcheck house.obj house
# Options that contradict each other.
try bplod house.obj --place 4.36,52.01,43 -o x
try bplod house.obj --profile 3dtiles --place 4,152,0 -o x
try bplod house.obj --profile 3dtiles --place 4,52,0 --crs EPSG:32631 -o x
try bplod house.obj --profile 3dtiles --origin 1,2,3 -o x
said 'bplod - --format obj --profile 3dtiles --crs EPSG:32631 -o x < house.obj'
files
