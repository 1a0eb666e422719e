# A proxy of a z-up scene says so, and every tool that reads it believes it unless told otherwise.
write_cube cube.obj 3
sed -i 's/^v 3 3 3/v 3 3 9/' cube.obj
bpvox cube.obj --resolution 30 --up z | bpmesh --faces 30 -o z.glb
bpvox cube.obj --resolution 30 | bpmesh --faces 30 -o y.glb
for proxy in z.glb y.glb cube.obj; do bpvox $proxy --resolution 20 | bpinfo | grep -o '. is up'; done
bpvox z.glb --resolution 20 --up y | bpinfo | grep -oE '. is up|up=.*'
for up in z y; do
  bpcheck cube.obj $up.glb --no-distances --image-size 99 --image $up.png > said || cat said
  bpcheck cube.obj $up.glb --no-distances --image-size 99 --image said.png --up $up > said && cmp $up.png said.png
  bpinfo $up.glb --image-size 99 --image info-$up.png > said
  bpinfo $up.glb --image-size 99 --image said.png --up $up --overwrite > said && cmp info-$up.png said.png
  rm said.png
done
cmp -s y.png z.png || echo 'the pictures differ'
