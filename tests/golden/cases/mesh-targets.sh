# Targets of bpmesh: what stops, what is said, and what is refused. A cube of 3 with a closing of 2 voxels.
some() { sed -E 's/[0-9]+ faces instead/SOME faces instead/; s/(tries refused: ).*/\1SOME)/'; }
write_cube cube.obj 3
bpvox cube.obj --resolution 40 | bpclose --scale 2vx -o cube.bpv
try bpmesh cube.bpv --faces 12 -o one.glb
try bpmesh cube.bpv --faces 40,20,12 -o chain.ply
for i in 0 1; do bpcheck chain.$i.ply chain.$((i + 1)).ply | tail -1; done
bpcheck cube.obj chain.0.ply | tail -1
said 'bpmesh cube.bpv --faces 40,20,12 -j 1 -o again.ply && for i in 0 1 2; do cmp chain.$i.ply again.$i.ply; done'
printf 'v 0 0 0\nv 9 1 0\nv 2 8 1\nv 3 2 7\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n' > slanted.obj
bpvox slanted.obj --resolution 50 -o slanted.bpv
for target in '--faces 100' '--error 1vx' '--volume 1.05 --enclose closing' '--faces 20 --volume 1.5 --error 65%'; do
  try bpmesh slanted.bpv $target --report report.json -o proxy.glb --overwrite
  grep stopped_by report.json
  bpcheck slanted.obj proxy.glb | tail -1
done
try bpmesh slanted.bpv --enclose slanted.obj --error 0.1vx -o near.glb
# Whatever keeps a proxy from the faces wanted is said, and stands in the report.
bpclose slanted.bpv --scale 2vx -o closed.bpv
for target in '--volume 1.05 --enclose closing' '--error 0.2vx' '--volume 1.05 --enclose closing --mode bounding -q'; do
  try bpmesh closed.bpv --faces 20 $target --report short.json -o short.ply --overwrite | some
  grep -cE '"(faces_asked": 20,|stopped_by)|faces instead of 20' short.json
done
try bpmesh cube.bpv --faces 12,40 -o wrong.glb
try bpmesh cube.bpv --faces 12,0 -o wrong.glb
try bpmesh cube.bpv --faces 12, -o wrong.glb
try bpmesh cube.bpv --faces 1,000 -o wrong.glb
try bplod cube.obj --faces 10,500 -o wrong
try bpmesh cube.bpv --faces 40,12 -o -
try bpmesh cube.bpv --faces 40,12 -o chain
for error in 0 0vx 0%; do try bpmesh cube.bpv --faces 12 --error $error -o wrong.glb; done
try bpmesh cube.bpv --volume 0.5 -o wrong.glb
try bpmesh cube.bpv --volume -1 -o wrong.glb
try bpmesh slanted.bpv --enclose closing --faces 60,40,12 --volume 1.15 -o coarser.ply | some
try bpmesh slanted.bpv --faces 60,20 --error 0.6vx -o near.ply | some
touch kept.1.glb
try bpmesh cube.bpv --faces 40,12 -o kept.glb
files
# Handles keep more faces than are wanted: what is asked for in vain is not paid for with spikes.
bp-plant --triangles 20000 -o plant.ply 2> /dev/null
bpvox plant.ply --resolution 256 -q | bpclose --scale 0.5% -q -o plant.bpv
for faces in 50 200; do
  bpmesh plant.bpv --faces $faces -q --report vain.json -o vain.glb --overwrite
  python3 - $faces << 'P'
import json, sys
counts = json.load(open("vain.json"))["counts"]
level = counts["levels"][0]
assert level["faces"] > 500, level
ratio = level["volume"] / counts["volume_of_voxels"]
print(f"{sys.argv[1]} wanted: volume " + ("below" if ratio < 2 else f"{ratio:.2f} instead of below") + " twice that of the voxels")
P
done
# Two far parts: no smaller number of faces holds less than a larger one, and eight are reached.
printf 'v %s\n' '0 0 0' '1 0 0' '0 1 0' '10 10 10' '11 10 10' '10 11 10' > far.obj
printf 'f 1 2 3\nf 4 5 6\n' >> far.obj
bpvox far.obj --resolution 256 -q -o far.bpv
for faces in 8 10 12 14 16 24; do
  bpmesh far.bpv --faces $faces -q -o far.ply --overwrite
  bpinfo far.ply --json | python3 -c 'import json, sys; j = json.load(sys.stdin); print(j["triangles"], j["volume"])'
done > far.txt
python3 - << 'P'
rows = [line.split() for line in open("far.txt")]
volumes = [float(volume) for _, volume in rows]
print("eight faces:", rows[0][0], "; volumes fall" if volumes == sorted(volumes, reverse=True) else f"; volumes rise: {volumes}")
P
# Where voxels are few for the faces, more faces asked hold no more: steps of voxels are not kept for their number.
python3 "$BP_ROOT/samples/scenes.py" . city > /dev/null
bpvox city.obj --resolution 200 -q | bpclose -q -o city.bpv
for faces in 3000 20000; do
  bpmesh city.bpv --faces $faces -q -o city.ply --overwrite
  bpinfo city.ply --json | python3 -c 'import json, sys; print(json.load(sys.stdin)["volume"])'
done > city.txt
awk 'NR == 1 { few = $1 } END { print "20000 faces asked:", ($1 < 1.01 * few ? "no" : $1 / few " times"), "more volume than 3000" }' city.txt
rm city.*
# Fewer faces than asked hold less: the voxels would give more, and the note does not deny it.
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' > one.obj
bpvox one.obj --resolution 256 -q -o one.bpv
try bpmesh one.bpv --faces 10 -o one.ply
rm far.* one.*
