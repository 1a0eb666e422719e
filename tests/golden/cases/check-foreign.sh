# Files of formats that Assimp reads, and that other programs read in another way: nothing is proven of them. Each line of the table: the
# answer that is right, the file of tests/data/bugs/readings_collada or readings_foreign, and whether it is the scene or the proxy.
write_cube cube.obj 1
awk '/^v/ { print "v", $2 * 0.1 + 0.4, $3 * 0.1 + 0.4, $4 * 0.1 + 0.4; next } { print }' cube.obj > small.obj
answers small.obj readings_collada readings_foreign << 'TABLE'
proven plain.dae scene
proven plain.dae proxy
undecided comment_in_corners.dae scene
undecided cdata_in_corners.dae scene
undecided instruction_in_corners.dae scene
undecided target_is_name.dae scene
undecided geometry_twice.dae scene
undecided geometry_twice.dae proxy
undecided offset.dae scene
undecided offset.dae proxy
undecided nameless.dae scene
undecided turned_axes.dae scene
undecided x_up.dae scene
undecided blank_up.dae scene
undecided two_scenes.dae scene
undecided two_scenes.dae proxy
undecided projective.dae scene
undecided asset_of_scene.dae scene
undecided no_target.dae scene
proven plain.ac scene
proven plain.ac proxy
undecided turned.ac scene
undecided turned_and_moved.ac scene
undecided kid_of_moved.ac scene
undecided group_with_surfaces.ac scene
undecided material_missing.ac scene
undecided more_kids.ac scene
undecided more_surfaces.ac scene
undecided more_vertices.ac scene
undecided text_as_line.ac scene
undecided name_of_lines.ac scene
undecided subdivided.ac proxy
undecided unknown_surface.ac scene
undecided moved_twice.ac scene
undecided hidden_edge.dxf scene
proven plain.dxf proxy
undecided invisible.dxf proxy
undecided on_paper.dxf proxy
undecided layer_off.dxf proxy
proven leader.dxf scene
undecided hidden.ac proxy
proven image_twice.dae scene
undecided plain.fbx scene
undecided plain.fbx proxy
undecided beams.3mf scene
undecided beams.3mf proxy
undecided other_part.3mf scene
undecided patch.x scene
TABLE

# All tools read such a file as before, and bpinfo tells that it is one.
bpinfo beams.3mf | grep -E "triangles|unread"
