"""Prints a DXF of triangles: Assimp reads it in single precision, so it stands for formats that are read with rounding."""


def print_dxf(vertices, triangles):
    print("0\nSECTION\n2\nENTITIES")
    for t in triangles:
        print("0\n3DFACE\n8\n0")
        for k, i in enumerate(t + (t[2],)):
            print("%d\n%r\n%d\n%r\n%d\n%r" % (10 + k, vertices[i][0], 20 + k, vertices[i][1], 30 + k, vertices[i][2]))
    print("0\nENDSEC\n0\nEOF")
