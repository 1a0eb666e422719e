#pragma once

/// The mains of the tools, under names of their own (CMakeLists.txt).
int bpvox_main(int argc, char** argv);
int bpscale_main(int argc, char** argv);
int bpclose_main(int argc, char** argv);
int bpmesh_main(int argc, char** argv);
int bpcheck_main(int argc, char** argv);
int bplod_main(int argc, char** argv);
int bpinfo_main(int argc, char** argv);
int bpdeform_main(int argc, char** argv);
