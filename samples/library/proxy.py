#!/usr/bin/env python3
"""Makes a bounding proxy of a scene, proves it, and covers it with convex hulls.
    samples/library/proxy.py SCENE PROXY"""
import sys

import bounding_proxies as bp


def main():
    if len(sys.argv) != 3 or sys.argv[1] in ("-h", "--help"):
        print(__doc__)
        return 2
    scene = bp.Scene(sys.argv[1])
    proxy = bp.proxy(scene, faces=1000, scale="1%")
    for note in proxy.notes:
        print("note:", note)
    verdict = bp.check(proxy, scene)
    print(verdict.text, end="")
    proxy.save(sys.argv[2], overwrite=True)
    print(len(bp.hulls(proxy, 16)), "convex hulls cover", sys.argv[2])
    return 0 if verdict else 1


if __name__ == "__main__":
    sys.exit(main())
