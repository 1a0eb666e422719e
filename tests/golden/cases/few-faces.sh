# A closed surface has at least four faces: a request for fewer is met as that for four, and never by more.
write_cube cube.obj
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n' > tetrahedron.obj
for scene in cube tetrahedron; do
  for faces in 1 2 3 4; do
    bplod $scene.obj --faces $faces --levels 1 --resolution 32 -q -o lod --overwrite | sed 1d | cut -f 2
  done | paste -s
done
# A library of materials that is no regular file is not opened, and named.
mkfifo pipe
sed '1i mtllib pipe' tetrahedron.obj > piped.obj
bplod piped.obj --faces 4 --levels 1 --resolution 32 -o lod --overwrite 2>&1 > /dev/null | grep 'piped.obj:'
rm -r lod pipe piped.obj cube.obj tetrahedron.obj
files
