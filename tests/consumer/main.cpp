// The smallest use of the installed library: two triangles and their neighbours.
#include <palpate/mesh/topology.h>

int main() {
  const palpate::mesh::TriangleMesh square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  return palpate::mesh::neighboursOfTriangles(square)[0][2] == 1 ? 0 : 1;
}
