# Cubes that are turned: by the scene's own directions, by frames at places, and what is refused.
awk 'BEGIN { c = cos(0.6); s = sin(0.6)
  for (i = 0; i < 8; ++i) { x = i % 2 ? 4 : 0; y = int(i / 2) % 2 ? 2 : 0; z = i > 3; printf "v %.6f %.6f %d\n", c * x - s * y, s * x + c * y, z } 
  n = split("1 3 4 2,5 6 8 7,1 2 6 5,3 7 8 4,1 5 7 3,2 4 8 6", f, ",")
  for (i = 1; i <= n; ++i) print "f " f[i] }' > box.obj
bpvox box.obj --resolution 100 -o box.bpv
echo '{"base": "4%", "orientation": "auto"}' > auto.json
said 'bpscale auto.json box.bpv -o auto.bpv'
said 'bpinfo auto.bpv | grep -E "^(scale |orientation)"'
try bpscale auto.json box.bpv --explain 1,1,0.5
# The same closing, whatever the threads and the memory; smaller than with cubes along the axes.
said 'bpclose auto.bpv -j 1 | bpinfo | checksum'
said 'bpclose auto.bpv -j 3 --memory 100M | bpinfo | checksum'
said 'bpclose auto.bpv | bpinfo | grep -E "^(element|orientation|closing)"'
said 'bpclose box.bpv --scale 4% | bpinfo | grep ^closing'
# Frames: a quaternion, or two axes.
echo '{"base": "4%", "orientation": [{"at": [0, 0, 0], "frame": [0.9553365, 0, 0, 0.2955202]}]}' > quaternion.json
echo '{"base": "4%", "orientation": [{"at": [0, 0, 0], "frame": [[0.8253356, 0.5646425, 0], [0, 0, 1]]}]}' > axes.json
for file in quaternion axes; do said "bpscale $file.json box.bpv | bpclose | bpinfo | checksum"; done
said 'bpclose auto.bpv --element ball | bpinfo | grep -E "^(element|orientation)"'
try bpclose --field auto.json box.bpv -o x.bpv
said 'bpvox - --format obj --resolution 20 < box.obj | bpscale auto.json'
for what in '"best"' '[]' '[{"at": [0, 0, 0]}]' '[{"at": [0, 0], "frame": [1, 0, 0, 0]}]' '[{"at": [0, 0, 0], "frame": [0, 0, 0, 0]}]' \
  '[{"at": [0, 0, 0], "frame": [[1, 0, 0], [2, 0, 0]]}]' '[{"at": [0, 0, 0], "frame": 7}]'; do
  echo "{\"base\": 1, \"orientation\": $what}" > bad.json
  try bpscale bad.json box.bpv
done
