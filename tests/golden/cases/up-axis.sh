# A proxy of a z-up scene says so, and every tool that reads it believes it unless told otherwise.
write_cube cube.obj 3
sed -i 's/^v 3 3 3/v 3 3 9/' cube.obj
bpvox cube.obj --resolution 30 --up z | bpmesh --faces 30 -q -o z.glb
bpvox cube.obj --resolution 30 | bpmesh --faces 30 -q -o y.glb
for proxy in z.glb y.glb cube.obj; do bpvox $proxy --resolution 20 | bpinfo | grep -o '. is up'; done
bpvox z.glb --resolution 20 --up y | bpinfo | grep -oE '. is up|up=.*'
for up in z y; do
  bpinfo cube.obj $up.glb --image-size 99 --image $up.png > said || cat said
  bpinfo cube.obj $up.glb --image-size 99 --image said.png --up $up > said && cmp $up.png said.png
  bpinfo $up.glb --image-size 99 --image info-$up.png > said
  bpinfo $up.glb --image-size 99 --image said.png --up $up --overwrite > said && cmp info-$up.png said.png
  rm said.png
done
cmp -s y.png z.png || echo 'the pictures differ'
# Levels of a z-up scene stay z-up, and so do levels of such levels; tilesets say it in their transforms.
for profile in gltf collision 3dtiles; do
  bplod z.glb --resolution 30 --levels 1 --faces 30 -q --profile $profile --name a -o $profile > list
  bplod z.glb --resolution 30 --levels 1 --faces 30 -q --profile $profile --name a --up z -o again > list
  cmp <(cat $profile/*) <(cat again/*) && rm -r again
done
for level in gltf/a_LOD0.glb gltf/a.glb collision/a_*.glb; do bpvox $level --resolution 20 | bpinfo | grep -o '. is up'; done
bplod gltf/a_LOD0.glb --resolution 30 --levels 1 --faces 30 -q --name a -o levels > list
bpvox levels/a_LOD0.glb --resolution 20 | bpinfo | grep -o '. is up'
for tileset in 3dtiles/tileset.json; do bpcheck z.glb $tileset | tail -1; done
bplod gltf/a_LOD0.glb --resolution 30 --levels 1 --faces 30 -q --name a --up y --overwrite -o levels > list
bpvox levels/a_LOD0.glb --resolution 20 | bpinfo | grep -o '. is up'
# Any axis may be up: a file comes back in the scene's own axes, and other readers see it stand.
for up in x -x -y -z; do
  bpvox cube.obj --resolution 30 --up $up | bpmesh --faces 30 -q -o up$up.glb
  bpvox up$up.glb --resolution 20 | bpinfo | grep -oE -- '-?[xyz] is up'
  bpcheck cube.obj up$up.glb -q | tail -1
  bpinfo cube.obj up$up.glb --image-size 99 --image up$up.png > said || cat said
  for profile in gltf 3dtiles; do
    bplod cube.obj -q --resolution 30 --levels 1 --faces 30 --up $up --profile $profile --name a -o up$up-$profile > list
  done
  bpcheck cube.obj up$up-gltf/a_LOD0.glb -q | tail -1
  bpcheck cube.obj up$up-3dtiles/tileset.json | tail -1
  bpinfo up$up-3dtiles/tileset.json | grep -oE 'up is -?[xyz]'
  for format in ply obj stl; do  # these have no axes
    bpvox cube.obj --resolution 30 --up $up | bpmesh --faces 30 -q -o up.$format
    bpvox cube.obj --resolution 30 | bpmesh --faces 30 -q -o plain.$format
    grep -av 'up=' up.$format | cmp - <(grep -av 'up=' plain.$format)
    rm up.$format plain.$format
  done
done
for up in w Z; do try bpvox cube.obj --up $up -o w.bpv; done
# glTF of a map is made with y up, and stands on edge, only with a note; nobody else is bothered.
awk '/^v/ { print "v", 20 * $2, 20 * $3, $4; next } { print }' cube.obj > map.obj
said 'bplod map.obj --resolution 30 --levels 1 --profile 3dtiles -o map > list'
said 'bplod map.obj --resolution 30 --levels 1 --profile 3dtiles --explain > list'
for up in y z; do said "bplod map.obj --resolution 30 --levels 1 --profile 3dtiles --up $up -o map.$up > list"; done
said 'bplod map.obj --resolution 30 --levels 1 -o flat > list'
for up in '' '--up y' '--up z'; do said "bpvox map.obj --resolution 60 $up | bpmesh --faces 30 -o flat.glb --overwrite"; done
said 'bpvox map.obj --resolution 60 | bpmesh --faces 30 -o flat.ply'
said 'bplod cube.obj --resolution 30 --levels 1 --profile 3dtiles -o upright > list'
said 'bplod z.glb --resolution 30 --levels 1 --profile 3dtiles -o told > list'
# glTF has y up by definition, whoever wrote it.
bpvox map.obj --resolution 60 | bpmesh --faces 30 -q -o map.gltf
sed -i 's/"up": *"y"/"by": "me"/' map.gltf
said 'bplod map.gltf --resolution 30 --levels 1 -o gltf-map > list'
cp map.gltf map && said 'bpvox map --format gltf --resolution 60 | bpmesh --faces 12 -o named.glb'
said 'bpvox map.gltf map.obj --resolution 60 | bpmesh --faces 12 -o both.glb'
said 'bpvox map.gltf --resolution 60 | bpmesh --faces 30 -o flat.glb --overwrite'
# A picture believes what a file tells, and says where --up differs.
for up in z y; do
  [ $up = z ] && other=y || other=z
  said "bpinfo $up.glb --up $other --image-size 99 --image told-$up.png > said" && cmp told-$up.png info-$up.png
done
said 'bpinfo cube.obj y.glb z.glb --up z --image-size 99 --image both.png > said'
# bpcheck says which turn it undoes. A turn that it cannot know leaves the answer open: a record that is not understood, none at all, or one by others.
bpvox cube.obj --resolution 30 --up z | bpmesh --faces 30 -q -o line.gltf
decided() { said "bpcheck $* > said"; grep -E '^(holds|does not|not decided)' said; }
decided cube.obj line.gltf
decided z.glb line.gltf
for up in '"up": "up"' '"up": 3' ''; do
  sed "s/\"up\": \"z\"/${up:-\"by\": \"me\"}/" line.gltf > other.gltf
  decided cube.obj other.gltf
done
decided --inside cube.obj other.gltf
sed 's/"up": "z"/"up": "up"/' line.gltf > other.gltf
decided --margin 1 cube.obj other.gltf
decided --inside cube.obj other.gltf
sed 's/"provenance"/"history"/' line.gltf > other.gltf
decided cube.obj other.gltf
# glTF has y up: of two such files neither needs a record.
sed 's/"up": "z"/"by": "me"/' line.gltf > other.gltf
decided y.glb other.gltf
