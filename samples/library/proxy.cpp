// Makes a bounding proxy of a file's scene, and proves it.
//   c++ -std=c++17 proxy.cpp $(pkg-config --cflags --libs bp) -o proxy && ./proxy scene.glb proxy.glb
#include <bp/bp.hpp>
#include <exception>
#include <iostream>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: proxy SCENE PROXY\n";
    return 2;
  }
  try {
    const bp::Scene scene(argv[1]);
    const bp::Mesh proxy = bp::Grid(scene).close("1%").mesh(1000);
    const bp::Verdict verdict(proxy, scene);
    std::cout << proxy.triangles().size() / 3 << " triangles\n" << verdict.text();
    proxy.save(argv[2], true);
    return verdict.holds() ? 0 : 1;
  } catch (const std::exception& e) {
    std::cerr << e.what() << '\n';
    return 1;
  }
}
