# Each file tells what it claims (docs/contracts.md), and bpcheck proves that, and says what it does not claim.
write_cube room.obj 4
claims() {  # FILE SCENE...
  try bpcheck --claimed "${@:2}" "$1" | grep -E '^([|=]|claims|does not claim|holds)|not decided|does not hold'
}
for mode in bounding fit; do
  bplod room.obj --mode $mode --faces 12 --levels 1 --resolution 16 --name $mode -q -o levels > /dev/null
  claims levels/$mode.glb room.obj
done
bplod room.obj --profile collision --resolution 16 -q -o levels > /dev/null
claims levels/room_unreal.glb room.obj
bplod room.obj --profile cage --resolution 16 -q -o levels > /dev/null
claims levels/room_cage.obj room.obj
bplod room.obj --profile occluder --resolution 16 -q -o levels > /dev/null
claims levels/room_occluder.glb room.obj

# Of the pipe, in each format. STL has no place for a claim.
bpvox room.obj --resolution 16 -q | bpclose --scale 0 -q > closed.bpv
for format in glb gltf ply obj stl; do
  bpmesh closed.bpv --faces 12 -q -o proxy.$format
  claims proxy.$format room.obj
done

# A file cannot choose an easier question than was asked: what claims to lie inside is asked to enclose.
bpcheck room.obj levels/room_occluder.glb 2> /dev/null | tail -1
# A claim that is false is refuted; one that needs a scene asks for it.
sed 's/contract: encloses/contract: inside/' proxy.obj > liar.obj
claims liar.obj room.obj
sed 's/contract: encloses/contract: best of all/' proxy.obj > boast.obj
claims boast.obj room.obj
# A file of two claims makes none.
sed 's/^# contract: encloses/&\n# contract: fit/' proxy.obj > both.obj
claims both.obj room.obj
claims proxy.ply
try bpcheck --claimed --inside room.obj proxy.ply
# A tileset claims what all its contents claim: fits among tiles cannot turn the question into an easier one.
write_ball ball.obj 3
bplod ball.obj --profile 3dtiles --faces 100,20 --resolution 16 -q -o tiles > /dev/null
claims tiles/tileset.json ball.obj
for level in 0 1; do
  cp -r tiles liars$level
  python3 - liars$level/ball_LOD$level.glb << 'P'
import json, struct, sys
data = open(sys.argv[1], "rb").read()
size = struct.unpack("<I", data[12:16])[0]
text = data[20:20 + size].replace(b'"contract":"tile"', b'"contract":"fit"').rstrip()
assert len(text) < size, "no claim was replaced"
open(sys.argv[1], "wb").write(data[:20] + text.ljust(size) + data[20 + size:])
P
  claims liars$level/tileset.json ball.obj
done
bplod ball.obj --profile 3dtiles --mode fit --faces 100,20 --resolution 16 -q -o fits > /dev/null
claims fits/tileset.json ball.obj
