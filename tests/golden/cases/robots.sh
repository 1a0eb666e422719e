# One file for each hull, and a MuJoCo model and a URDF that name them.
box() {  # X0 X1 Y0 Y1 Z0 Z1: a convex part, turned by some 24 degrees
  for i in 0 1 2 3 4 5 6 7; do
    awk -v x=$(($i & 1 ? $2 : $1)) -v y=$(($i & 2 ? $4 : $3)) -v z=$(($i & 4 ? $6 : $5)) 'BEGIN { print "v", 0.9 * x - 0.4 * y, 0.4 * x + 0.9 * y, z }'
  done
  for f in '1 3 4 2' '5 6 8 7' '1 2 6 5' '3 7 8 4' '1 5 7 3' '2 4 8 6'; do echo "f $(for v in $f; do echo -n "$((v + n)) "; done)"; done
  n=$((n + 8))
}
n=0
{ box 0 80 0 3 0 30; box 0 80 57 60 0 30; box 0 3 3 57 0 30; box 77 80 3 57 0 30; box -5 85 -5 65 30 34; } > house.obj
try bplod house.obj --up z --profile collision --hull-files obj -q -o robot | cut -f 1
(cd robot && files)

# Convex parts become hulls as they are: their volumes together are the scene's.
share() { awk -v a="$(bpinfo "$1" | sed -n 's/^volume *//p')" -v b="$(bpinfo "$2" | sed -n 's/^volume *//p')" 'BEGIN { print (a > b && a < 1.03 * b ? "the volume of the scene" : "another volume: " a " for " b) }'; }
share robot/house_unreal.glb house.obj
bpcheck --convex house.obj robot/house_unreal.glb 2> /dev/null | tail -1
for f in robot/house_hull_*.obj; do echo "$f: $(grep -c '^v ' "$f") corners, $(bpcheck --claimed house.obj "$f" | sed -n '1p;$p' | tr '\n' ' ')"; done
try bpcheck --claimed robot/house_hull_00.obj | tail -1
grep -o 'file="[^"]*"' robot/house_mujoco.xml | tr '\n' ' '; echo
grep -o 'filename="[^"]*"' robot/house.urdf | tr '\n' ' '; echo

# Only the rest is decomposed: an angle beside the house.
n=40
{ cat house.obj; box 100 140 0 10 0 10; } > more.obj
write_ball ball.obj 30
awk '$1 == "v" { $2 += 200; if ($4 == 0) $4 = 12 } { print }' ball.obj > dented.obj
bplod more.obj dented.obj --name more --up z --profile collision -q -o more > /dev/null
bpcheck --convex more.obj dented.obj more/more_unreal.glb 2> /dev/null | tail -1

# Corners are a limit that no hull breaks, and no hull loses what it held.
for corners in 8 12 64; do
  bplod ball.obj --profile collision --resolution 60 --hull-corners $corners --hull-files stl -q -o ball --overwrite > /dev/null
  bpcheck --convex ball.obj ball/ball_unreal.glb 2> /dev/null | tail -1
  for f in ball/ball_hull_*.stl; do bpinfo $f | awk -v n=$corners '/^triangles/ { print ($2 <= 2 * n - 4 ? "few enough corners" : $2 " faces") }'; done | sort -u
done

# Hulls of an earlier run do not stay behind: a simulator would take them, too.
touch robot/house_hull_07.stl robot/house_hull_x.obj
bplod house.obj --up z --profile collision --hull-files obj --hulls 2 -q -o robot --overwrite > /dev/null
(cd robot && files)
try bplod house.obj --up z --profile collision --hull-files obj -q -o robot
try bplod house.obj --hull-files obj -o x
try bplod house.obj --profile collision --hull-files ply -o x
try bplod house.obj --profile collision --hull-corners 65 -o x
bplod house.obj --up z --name 'a "b" <c>&d' --profile collision --hull-files stl --hulls 2 -q -o odd > /dev/null
grep -o 'file.*=.*"' odd/*.urdf odd/*.xml | sed 's/^[^:]*://'
