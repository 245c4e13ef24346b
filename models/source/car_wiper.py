"""Two wipers in tandem. Their axes are fitted so that a straight, slightly bent blade follows the curved glass."""
import bpy
import numpy as np

import car_shape as shape
from car_glass import surface_normals
from car_mesh import Part, axes_for, lathe, place, rounded_box, unit

# pivot (u, v) on the glass, rest angle above the line to the right, sweep, pivot to the blade's middle, blade
WIPERS = {
    "wiper_driver": dict(pivot=(0.815, 0.012), rest_deg=-4.0, sweep_deg=89.0, arm_m=0.435, blade_m=0.63),
    "wiper_passenger": dict(pivot=(-0.045, 0.012), rest_deg=10.0, sweep_deg=94.0, arm_m=0.42, blade_m=0.52),
}


def glass_gap(points):
    """Signed distance of points from the windscreen along its normal, and their (u, v)."""
    points = np.asarray(points, float)
    uv = np.stack([points[:, 1] / 0.68, (points[:, 2] - shape.SCREEN_FOOT[2]) / 0.4], -1)
    e = 1e-4
    for _ in range(8):
        q = shape.screen(uv)
        du = (shape.screen(uv + [e, 0]) - shape.screen(uv - [e, 0])) / (2 * e)
        dv = (shape.screen(uv + [0, e]) - shape.screen(uv - [0, e])) / (2 * e)
        a = np.stack([du, dv], -1)
        step = np.linalg.solve(np.einsum("nij,nik->njk", a, a), np.einsum("nij,ni->nj", a, points - q)[..., None])[..., 0]
        uv = uv + step
    n = surface_normals(shape.screen, uv)
    return np.einsum("ni,ni->n", points - shape.screen(uv), n), uv


class Wiper:
    """Geometry of one wiper: node frame at rest, and its blade's points at any angle."""

    def __init__(self, pivot, rest_deg, sweep_deg, arm_m, blade_m):
        self.arm_m, self.blade_m, self.sweep_deg = arm_m, blade_m, sweep_deg
        uv = np.array([pivot])
        self.origin = shape.screen(uv)[0]
        self.normal = surface_normals(shape.screen, uv)[0]
        self.rest_deg = rest_deg
        self.fit = np.zeros(5)  # axis tilt along x and y, lift (m), the blade's bend (1/m) and skew (1/m2)
        self._settle()

    def frame(self, fit):
        across = unit(np.array([0, -1.0, 0]) - np.dot([0, -1.0, 0], self.normal) * self.normal)
        up = np.cross(across, self.normal)
        axis = unit(self.normal + fit[0] * across + fit[1] * up)
        a = np.radians(self.rest_deg)
        x = unit(np.cos(a) * across + np.sin(a) * up)
        x = unit(x - np.dot(x, axis) * axis)
        return axis, x, np.cross(x, axis)  # the last lies uphill of the resting arm

    def blade(self, angle_deg, along, fit=None):
        """Points of the blade's lip; `along` from the blade's middle, angle 0 at rest to sweep_deg."""
        fit = self.fit if fit is None else fit
        axis, x, up = self.frame(fit)
        a = np.radians(angle_deg)[:, None, None]
        r = (self.arm_m + along)[None, :, None]
        lift = self.lift(along, fit)[None, :, None]
        return self.origin + r * (np.cos(a) * x + np.sin(a) * up) + lift * axis

    def lift(self, along, fit=None):
        fit = self.fit if fit is None else fit
        return fit[2] + fit[3] * along**2 + fit[4] * along**3

    def gaps(self, fit=None, angles=25, points=15):
        angle = np.linspace(0, self.sweep_deg, angles)
        along = np.linspace(-0.5, 0.5, points) * self.blade_m
        return glass_gap(self.blade(angle, along, fit).reshape(-1, 3))

    def _settle(self):
        for _ in range(30):  # large distances weigh more, which evens out the worst of them
            base = self.gaps()[0]
            weight = (np.abs(base - 0.002) / np.abs(base - 0.002).max())**2 + 0.05
            e = np.array([1e-3, 1e-3, 1e-3, 1e-2, 1e-2])
            jac = np.stack([(self.gaps(self.fit + np.eye(5)[k] * e[k])[0] - base) / e[k] for k in range(5)], -1)
            self.fit = self.fit - 0.5 * np.linalg.lstsq(jac * weight[:, None], (base - 0.002) * weight, rcond=None)[0]


def make_wipers(material_of):
    result = {}
    for name, spec in WIPERS.items():
        w = result[name] = Wiper(**spec)
        axis, x, up = w.frame(w.fit)
        basis = axes_for(axis, x)
        extras = {"type": "wiper", "name": name, "pane": "windscreen", "arm_m": w.arm_m, "blade_m": w.blade_m, "blade_angle_deg": 0.0,
                  "sweep_deg": -w.sweep_deg}
        node = place(bpy.data.objects.new(name, None), w.origin, basis, rainglass=extras)
        at = lambda r, side, h: w.origin + r * x + side * up + h * axis
        make_blade(name, w, at, basis, node, material_of)
        make_arm(name, w, at, basis, node, material_of)
    return result


def make_blade(name, w, at, basis, node, material_of):
    """A flat blade: rubber lip on the glass, spoiler above it."""
    along = np.linspace(-0.5, 0.5, 17) * w.blade_m
    lip = w.lift(along)
    part = Part(name + "_blade")
    sections = [("rubber", [(-0.0012, 0.0), (0.0012, 0.0), (0.0035, 0.009), (-0.0035, 0.009)]),
                ("black_plastic", [(-0.007, 0.008), (0.007, 0.008), (0.006, 0.013), (0.001, 0.020), (-0.002, 0.020), (-0.005, 0.013)])]
    for material, section in sections:
        rows = [[at(w.arm_m + a, s * taper(a, w.blade_m), l + 0.0 + h * (0.6 + 0.4 * taper(a, w.blade_m))) for s, h in section]
                for a, l in zip(along, lip)]
        n = len(section)
        verts = np.array(rows).reshape(-1, 3)
        faces = [(i * n + j, (i + 1) * n + j, (i + 1) * n + (j + 1) % n, i * n + (j + 1) % n) for i in range(len(along) - 1) for j in range(n)]
        faces += [tuple(range(n)), tuple(range(len(verts) - n, len(verts)))[::-1]]
        part.add(verts, outward(verts, faces), material)
    v, f = rounded_box(at(w.arm_m, 0.0, w.fit[2] + 0.019), (0.016, 0.060, 0.014), 0.004, basis)
    part.add(v, f, "black_plastic")
    part.build(material_of, w.origin, basis, node)


def taper(a, blade_m):
    return 1 - 0.45 * (2 * abs(a) / blade_m)**4


def outward(verts, faces):
    """Turns a closed mesh's faces outward, judged by its signed volume."""
    c = verts.mean(0)
    volume = sum(np.dot(verts[f[0]] - c, np.cross(verts[f[i]] - c, verts[f[i + 1]] - c)) for f in faces for i in range(1, len(f) - 1))
    return faces if volume > 0 else [tuple(f)[::-1] for f in faces]


def make_arm(name, w, at, basis, node, material_of):
    """Knuckle on the pivot, then a tapering arm to the blade's middle."""
    part = Part(name + "_arm")
    lift = w.fit[2]
    v, f = lathe([(0.0, 0.034), (0.010, 0.033), (0.014, 0.028), (0.015, 0.0), (0.019, -0.012)], 16, w.origin, basis[:, 2], basis[:, 1])
    part.add(v, [t[::-1] for t in f], "black_plastic")
    end = w.arm_m + 0.015
    r = np.array([-0.022, 0.0, 0.05, 0.12, 0.22, 0.32, end - 0.03, end])
    h = np.array([0.026, 0.029, 0.033, 0.036, 0.037, 0.037, 0.036, 0.030]) + lift
    half = np.array([0.010, 0.013, 0.012, 0.0105, 0.0075, 0.006, 0.006, 0.0055])
    thick = np.array([0.006, 0.008, 0.008, 0.007, 0.0055, 0.005, 0.005, 0.005])
    section = np.array([(-1, -1), (1, -1), (1, 0.3), (0.6, 1), (-0.6, 1), (-1, 0.3)])
    n = len(section)
    verts = np.array([[at(a, s * b, c + t * d) for s, t in section] for a, b, c, d in zip(r, half, h, thick)]).reshape(-1, 3)
    faces = [(i * n + j, (i + 1) * n + j, (i + 1) * n + (j + 1) % n, i * n + (j + 1) % n) for i in range(len(r) - 1) for j in range(n)]
    faces += [tuple(range(n)), tuple(range(len(verts) - n, len(verts)))[::-1]]
    part.add(verts, outward(verts, faces), "black_plastic")
    part.build(material_of, w.origin, basis, node)


def report(wipers):
    """What the wipers do: blade's distance from the glass, share of the driver's zone wiped."""
    yaw, pitch = np.meshgrid(np.radians(np.linspace(-20, 14, 35)), np.radians(np.linspace(-5, 7, 25)))
    direction = np.stack([np.cos(yaw) * np.cos(pitch), np.sin(yaw) * np.cos(pitch), np.sin(pitch)], -1).reshape(-1, 3)
    zone = shape.EYE + 0.6 * direction
    for _ in range(12):
        gap, _ = glass_gap(zone)
        n = np.array([0.5, 0, 0.866])
        zone = zone - direction * (gap / (direction @ n))[:, None]
    swept = np.zeros(len(zone), bool)
    lines = []
    for name, w in wipers.items():
        gap, uv = w.gaps(angles=91, points=41)
        share = (np.abs(gap) < 0.006).mean()
        reach = (np.abs(uv[:, 0]).max(), uv[:, 1].min(), uv[:, 1].max())
        lines.append(f"{name}: blade to glass {gap.min()*1e3:.1f}..{gap.max()*1e3:.1f} mm ({100*share:.0f} % within 6 mm), |u| <= {reach[0]:.3f}, v {reach[1]:.3f}..{reach[2]:.3f}")
        axis, x, up = w.frame(w.fit)
        d = zone - w.origin
        r = np.linalg.norm(d - (d @ axis)[:, None] * axis, axis=1)
        a = np.degrees(np.arctan2(d @ up, d @ x))
        swept |= (np.abs(r - w.arm_m) <= w.blade_m / 2) & (a >= 0) & (a <= w.sweep_deg)
    lines.append(f"driver's zone (-20..14 deg across, -5..7 deg up) swept: {100*swept.mean():.1f} %")
    return lines
