# Occluders of buildings that somebody enters: rooms are filled, or left open; bpcheck proves either.
# write_house FILE [PART...]: a house of 8 x 6 x 3 with a door of 1 x 2.1 and a window of 1.4 x 1; parts: leaf, inner.
write_house() {
  local file=$1 boxes="-0.3 -0.3 3 8.3 6.3 3.3 -0.3 -0.3 -0.3 8.3 6.3 0 -0.3 -0.3 0 0 6.3 3 8 -0.3 0 8.3 6.3 3"
  boxes+=" 0 -0.3 0 2 0 3 3 -0.3 0 8 0 3 2 -0.3 2.1 3 0 3"                                     # the door
  boxes+=" 0 6 0 1.5 6.3 3 2.9 6 0 8 6.3 3 1.5 6 0 2.9 6.3 0.9 1.5 6 1.9 2.9 6.3 3"               # the window
  shift
  for part in "$@"; do
    case $part in
      leaf) boxes+=" 2 -0.2 0 3 -0.1 2.1" ;;
      inner) boxes+=" 5 0 0 5.2 6 3" ;;
    esac
  done
  awk -v list="$boxes" 'BEGIN {
    n = split(list, x, " ")
    for (i = 1; i <= n; i += 6) {
      for (k = 0; k < 8; ++k) print "v", x[i + (k % 2) * 3], x[i + 1 + (int(k / 2) % 2) * 3], x[i + 2 + int(k / 4) * 3]
      split("1 3 4 2 5 6 8 7 1 2 6 5 3 7 8 4 1 5 7 3 2 4 8 6", f, " ")
      for (k = 1; k <= 24; k += 4) print "f", f[k] + c, f[k + 1] + c, f[k + 2] + c, f[k + 3] + c
      c += 8
    }
  }' > "$file"
}
# occluder SCENE [ARGUMENT...]: makes one, proves it, and tells what is hidden.
occluder() {
  local scene=$1
  shift
  try bplod "$scene.obj" --profile occluder --resolution 160 --up z "$@" -o "$scene" --overwrite --report report.json
  grep -E '^ *"(hidden|body|entered)": [0-9]' report.json | tail -3 | tr -d ' \n'; echo
  said "bpcheck --inside $scene.obj $scene/${scene}_occluder.glb | grep -E 'hidden|hold'"
}
write_house house.obj
write_house shut.obj leaf
write_house two.obj inner
for scene in house shut two; do
  for rooms in filled open; do occluder $scene --rooms $rooms; done
done
# One who is taller than the door, or smaller: then the window is large enough, too.
occluder house --rooms 2.4
occluder shut --rooms 0.8
occluder house --rooms open --scale 0.3
# The occluder of the filled rooms does not hold for one who enters: the file's own words are changed to those.
said 'bplod house.obj --profile occluder --resolution 160 --up z --rooms filled -o filled -q > /dev/null; sed -i "s/tighten=yes/body=1.8000/" filled/house_occluder.glb; bpcheck --inside house.obj filled/house_occluder.glb | grep -E "hidden|hold"'
# Nor for one who lies on his side: another axis than the file's makes no recipe. A ground that is added is told.
said 'sed -i "s/ up=z / up=x /" filled/house_occluder.glb; bpcheck --inside house.obj filled/house_occluder.glb | grep -E "hidden|hold|inside"'
said 'sed "s/ground=no /ground=yes /; s/tighten=yes/tighten=ye/" house/house_occluder.glb > y.glb; bpcheck --inside house.obj y.glb | grep -E "hidden|hold"'
# A body taller than all of the scene, and one beyond all voxels.
occluder house --rooms 180
try bplod house.obj --profile occluder --resolution 160 --up z --rooms 1e9 -o wrong
# Same bytes, whatever the threads and the memory.
for threads in 1 4; do bplod two.obj --profile occluder --resolution 160 --up z --rooms open -j $threads --memory ${threads}G -q -o t$threads > /dev/null; done
said 'cmp t1/two_occluder.glb t4/two_occluder.glb'
try bplod house.obj --profile occluder --up z --rooms 0.01 -o wrong
try bplod house.obj --profile occluder --rooms 0 -o wrong
try bplod house.obj --profile occluder --rooms shut -o wrong
try bplod house.obj --rooms open -o wrong
