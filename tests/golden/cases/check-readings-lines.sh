# Lines of text files that some programs read in another way, since they are not of the form that nearly all files have. Each line of the
# table: the answer that is right, the file of tests/data/bugs/readings_lines, and whether it is the scene or the proxy.
write_cube cube.obj 1
answers cube.obj readings_lines << 'TABLE'
proven plain.obj scene
undecided weight.obj scene
undecided numbers_of_vertex.obj scene
undecided comment_of_face.obj scene
undecided no_place.obj scene
undecided later.obj scene
undecided plus.obj scene
undecided blank.obj scene
undecided mark.obj scene
undecided form_feed.obj scene
undecided zero.obj scene
undecided lines_beside.obj proxy
proven lines_beside.obj scene
undecided points_beside.obj proxy
proven points_beside.obj scene
undecided plus.ply scene
undecided face_of_two_lines.ply scene
undecided vertex_of_two_lines.ply scene
undecided fractions.ply scene
undecided too_large.ply scene
undecided end_in_comment.ply scene
undecided end_of_words.ply scene
refused formats.ply scene
undecided strips_beside.ply proxy
proven strips_beside.ply scene
undecided plus.off scene
undecided face_of_two_lines.off scene
undecided comment_of_face.off scene
undecided upper.stl scene
refused bytes_behind.stl scene
TABLE
