#!/usr/bin/env python3
"""Asks the IPC Toolkit's Python module (pip install ipctk, 1.x) the questions of a set, and writes
results_ipctk.json. Run: python3 ipc_toolkit.py [DIR of the set]"""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import vectors

try:
    import ipctk
    import numpy as np
    ccd = ipctk.TightInclusionCCD() if hasattr(ipctk, "TightInclusionCCD") else ipctk
except ImportError as missing:
    print(f"ipc_toolkit.py: {missing} (pip install ipctk numpy)", file=sys.stderr)
    sys.exit(2)


class IpcToolkit:
    """Asks Tight-Inclusion about two features, and is_step_collision_free about whole steps."""
    name = "ipctk"
    version = getattr(ipctk, "__version__", "unknown")
    settings = "Tight-Inclusion, defaults"

    def vertex_face_within(self, distance, t0, t1):
        return self.told(ccd.point_triangle_ccd, distance, t0, t1)

    def edge_edge_within(self, distance, t0, t1):
        return self.told(ccd.edge_edge_ccd, distance, t0, t1)

    def vertex_face(self, t0, t1):
        return self.vertex_face_within(0.0, t0, t1)

    def edge_edge(self, t0, t1):
        return self.edge_edge_within(0.0, t0, t1)

    def told(self, function, distance, t0, t1):
        points = [np.array(point, dtype=float) for point in (*t0, *t1)]
        hits, time = function(*points, min_distance=distance)
        return f"collision {time!r}" if hits else "free"

    def mesh(self, triangles, points):
        faces = np.array(triangles, dtype=np.int32)
        return ipctk.CollisionMesh(np.array(points, dtype=float), ipctk.edges(faces), faces)

    def step(self, triangles, t0, t1):
        return not ipctk.is_step_collision_free(self.mesh(triangles, t0), np.array(t0, dtype=float),
                                                np.array(t1, dtype=float))

    def limit(self, triangles, t0, t1):
        return ipctk.compute_collision_free_stepsize(
            self.mesh(triangles, t0), np.array(t0, dtype=float), np.array(t1, dtype=float))


results = vectors.run(IpcToolkit(), set=sys.argv[1] if len(sys.argv) > 1 else None)
vectors.write_results(results, "results_ipctk.json")
sys.exit(vectors.main(["score", "results_ipctk.json"] +
                      (["--set", sys.argv[1]] if len(sys.argv) > 1 else [])))
