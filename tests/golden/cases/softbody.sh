# The sample of a soft body: cages fall, the scene follows, and nothing passes through the floor.
write_cube cage.obj 4
write_octahedron scene.obj
said '"$BP_ROOT/samples/softbody.py" scene.obj cage.obj soft 30 && ls soft | wc -l'
said 'grep -c acTL soft/softbody.png'
said "for n in 00 15 29; do awk '/^v / { y = \$3; if (!n++ || y < low) low = y } END { print (low < -0.001 ? \"below\" : \"above\") }' soft/cage.0\$n.obj; done"
said 'cmp soft/scene.00.obj soft/scene.29.obj > /dev/null || echo moved'
