"""Effects of fxsdk in Python: simulation with numpy columns, and pictures without a window.

    import fxsdk
    pixels = fxsdk.render("explosion", time=0.6)
    fxsdk.write_png("explosion.png", pixels)

    with fxsdk.Context() as context:
        scene = context.scene()
        scene.add("explosion")
        scene.update(0.6)
        for group in scene.groups():
            print(group.kind, group.columns["radius"].mean())

The C API is there whole: fxsdk.fx has its functions, fxsdk.structs its structs, fxsdk.constants its constants. Units are
metre, second, kilogram and kelvin, +Y is up. Failed calls raise fxsdk.Error with the message of the library.
Threads: a scene is used on the thread that created it, a view on that of its context.
"""
import ctypes
import dataclasses
import math
import struct as _binary
import weakref
import zlib

import numpy

from fxsdk._binding import API, Error, assign, constants, default, filled, fx, opaque, structs
from fxsdk._offscreen import Offscreen

__all__ = ["Context", "Error", "Group", "Offscreen", "Scene", "View", "constants", "default", "fx", "render", "structs", "write_png"]
__version__ = API["version"]

_STEP = 1.0 / 60.0  # [s]
_NEAR = 0.05  # [m] distance of the near plane


#: Definitions of contexts that exist in the library: their callbacks are called until the context is destroyed.
_definitions = {}


class _Object:
    """Owns an object of the C API. @param pointer to it; null when it is destroyed"""

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


class _Owned(_Object):
    """A scene or a view, which keeps its context."""
    _destroy = None

    def __init__(self, context, pointer):
        self._context = context
        self._pointer = pointer
        context._owned.add(self)

    @property
    def pointer(self):
        """To the object of the C API. Raises ValueError when it is destroyed."""
        if not self._pointer:
            what = "the context" if not self._context.pointer else f"the {type(self).__name__.lower()}"
            raise ValueError(f"{what} is closed")
        return self._pointer

    def close(self):
        if self._pointer:
            self._destroy(self._pointer)
            self._pointer = None


class Context(_Object):
    """Loaded presets, and the hooks of the host.

    @param gl True where a context of OpenGL 4.5 of EGL, GLX or SDL is current, such as that of an Offscreen; or a function that
              takes the name of a function of OpenGL as bytes and returns its address. Without it nothing can be drawn.
    @param members of FxContextDef, such as workers=1, or unitsPerMeter=100 for centimeters
    """

    def __init__(self, gl=None, **members):
        definition = assign(default("FxContextDef"), members)
        failures = []
        if gl is not None and gl is not False:
            find = (lambda name: fx.fxGetGlProcAddress(None, name)) if gl is True else gl

            def address(user, name):
                try:
                    return find(name) or 0
                except Exception as failure:  # must not pass through the library
                    failures.append(failure)
                    return 0

            loader = definition.gl
            loader.getProcAddress = dict(loader._fields_)["getProcAddress"](address)
        self._presets = {}
        self._owned = weakref.WeakSet()
        self.pointer = opaque("FxContext")
        try:
            fx.fxCreateContext(ctypes.byref(definition), ctypes.byref(self.pointer))
        except Error:
            if failures:
                raise failures[0]
            raise
        _definitions[self._key()] = definition

    def _key(self):
        return ctypes.cast(self.pointer, ctypes.c_void_p).value

    def load(self, name):
        """The preset of a *.fx.json file, or of the library under a name such as "explosion"; loaded once."""
        if name not in self._presets:
            preset = structs.FxPresetId()
            load = fx.fxLoadPresetFile if name.endswith(".json") else fx.fxLoadPresetLibrary
            load(self._open(), name.encode(), ctypes.byref(preset))
            self._presets[name] = preset
        return self._presets[name]

    def preview(self, name):
        """How the author of a preset shows it: FxPresetPreview. @param name as for load()"""
        return filled("FxPresetPreview", fx.fxGetPresetPreview, self._open(), self.load(name))

    def preview_settings(self, name):
        """Members of FxViewSettings for view(): exposure, light and composition with which the author of a preset shows it.
        @param name as for load()"""
        settings = default("FxViewSettings")
        fx.fxSetPreviewSettings(self._open(), self.load(name), ctypes.byref(settings))
        return {member: getattr(settings, member) for member in
                ("composition", "multipleScattering", "exposureEv100", "sunDirection", "sunIlluminance", "skyLuminance", "groundAlbedo")}

    def camera(self, eye, target, width, height, fov_y=math.radians(50.0), near=_NEAR, **members):
        """Members of FxFrameDef for View.render(), with a camera of fxSetFrameCamera().

        @param eye     [m] where the camera is, in units and axes of the context
        @param target  [m] where it looks
        @param width   [pixel] of the picture
        @param height  [pixel] of the picture
        @param fov_y   [rad] vertical field of view
        @param near    [m] distance of the near plane
        @param members other members of FxFrameDef, such as colorTexture
        """
        return _with_camera(dict(members, width=width, height=height), fx.fxSetFrameCamera, self._open(),
                            (ctypes.c_double * 3)(*eye), (ctypes.c_double * 3)(*target), fov_y, near)

    def _open(self):
        if not self.pointer:
            raise ValueError("the context is closed")
        return self.pointer

    def scene(self, **members):
        """A new Scene. @param members of FxSceneDef"""
        return Scene(self, **members)

    def view(self, scene, **settings):
        """A new View. @param settings members of FxViewSettings"""
        return View(self, scene, **settings)

    def memory(self):
        """FxMemoryStats."""
        return filled("FxMemoryStats", fx.fxContext_GetMemoryStats, self._open())

    def close(self):
        """Destroys the context with its scenes and views."""
        if self.pointer:
            key = self._key()
            fx.fxDestroyContext(self.pointer)
            for owned in self._owned:
                owned._pointer = None
            self.pointer = None
            del _definitions[key]


@dataclasses.dataclass(frozen=True)
class Group:
    """The particles of one solver of one instance. Arrays are copies."""
    kind: str              #: such as "blob"
    instance: int          #: FxInstanceId.bits
    solver: int            #: index in the preset
    scale: float           #: [1] of the placement
    position: numpy.ndarray  #: [m] of the placement, in the world
    rotation: numpy.ndarray  #: of the placement, unit quaternion x, y, z, w
    ids: numpy.ndarray     #: of the elements, ascending; empty where the kind has none
    units: dict            #: name of a column -> SI unit
    columns: dict          #: name of a column -> numpy array in the group's own axes

    @property
    def positions(self):
        """[m] positions of the elements in the world, count x 3."""
        local = numpy.stack([self.columns[axis] for axis in "xyz"], axis=1).astype(float) * self.scale
        axis, w = self.rotation[:3], self.rotation[3]
        turned = local + 2.0 * numpy.cross(axis, numpy.cross(axis, local) + w * local)
        return self.position + turned


class Scene(_Owned):
    """Instances of effects, and a clock."""
    _destroy = staticmethod(fx.fxDestroyScene)

    def __init__(self, context, **members):
        definition = assign(default("FxSceneDef"), members)
        pointer = opaque("FxScene")
        fx.fxCreateScene(context._open(), ctypes.byref(definition), ctypes.byref(pointer))
        super().__init__(context, pointer)

    def add(self, preset, **members):
        """An instance of a preset, named as for Context.load(). @param members of FxInstanceDef, such as
        position=(0, 1, 0) @return its FxInstanceId"""
        definition = assign(default("FxInstanceDef"), members)
        definition.preset = self._context.load(preset)
        instance = structs.FxInstanceId()
        fx.fxScene_CreateInstance(self.pointer, ctypes.byref(definition), ctypes.byref(instance))
        return instance

    def remove(self, instance):
        fx.fxScene_DestroyInstance(self.pointer, instance)

    def update(self, seconds):
        """Adds time of any length: whole frames of 1/60 s, and what remains. @param seconds [s] >= 0"""
        if not (math.isfinite(seconds) and seconds >= 0.0):
            fx.fxScene_Update(self.pointer, seconds)  # fails and says why
        frames = int(seconds / _STEP + 1e-6)
        for _ in range(frames):
            fx.fxScene_Update(self.pointer, _STEP)
        rest = seconds - frames * _STEP
        if rest > 1e-6 * _STEP:
            fx.fxScene_Update(self.pointer, rest)

    def move(self, instance, position, rotation=(0, 0, 0, 1), scale=1.0):
        """@param position [m] @param rotation unit quaternion x, y, z, w"""
        fx.fxScene_SetTransform(self.pointer, instance, (ctypes.c_double * 3)(*position),
                                (ctypes.c_float * 4)(*rotation), scale)

    def follow(self, instance, position, rotation=(0, 0, 0, 1), **members):
        """Adds a pose to the path of an instance. @param members of FxMotion, such as aheadSeconds=1 / 60"""
        motion = assign(default("FxMotion"), dict(members, position=position, rotation=rotation))
        fx.fxScene_SetMotion(self.pointer, instance, ctypes.byref(motion))

    def reserve(self, preset, count, quality=0):
        """Allocates the memory of `count` instances of a preset in advance; 0 frees it."""
        fx.fxScene_ReservePreset(self.pointer, self._context.load(preset), quality, count)

    def statistics(self):
        """FxSceneStatistics."""
        return filled("FxSceneStatistics", fx.fxScene_GetStatistics, self.pointer)

    def hash(self):
        """Of the bits of every particle of the last step; the same on every machine."""
        value = ctypes.c_uint64()
        fx.fxScene_GetStateHash(self.pointer, ctypes.byref(value))
        return value.value

    def camera(self, instance, width, height, near=_NEAR, **members):
        """Members of FxFrameDef for View.render(), with a camera that sees an instance, of fxScene_SetFrameCamera(). @param
        members as of Context.camera()"""
        return _with_camera(dict(members, width=width, height=height), fx.fxScene_SetFrameCamera, self.pointer, instance, near)

    def groups(self, kind=None):
        """The particles of the last step as a list of Group. @param kind only groups of this kind, such as "blob" """
        snapshot = structs.FxSnapshotId()
        fx.fxScene_AcquireSnapshot(self.pointer, ctypes.byref(snapshot))
        try:
            info = filled("FxSnapshotInfo", fx.fxScene_GetSnapshotInfo, self.pointer, snapshot)
            groups = [self._group(snapshot, index) for index in range(info.groupsNewer)]
        finally:
            fx.fxScene_ReleaseSnapshot(self.pointer, snapshot)
        return [group for group in groups if kind is None or group.kind == kind]

    def _group(self, snapshot, index):
        newer = constants.FX_SNAPSHOT_NEWER
        group = filled("FxSnapshotGroup", fx.fxScene_GetSnapshotGroup, self.pointer, snapshot, newer, index)
        columns, units = {}, {}
        for c in range(group.columnCount):
            column = filled("FxSnapshotColumn", fx.fxScene_GetSnapshotColumn, self.pointer, snapshot, newer, index, c)
            values = column.values or column.values64
            if values:
                columns[column.name.decode()] = _copied(values, column.count)
                units[column.name.decode()] = column.unit.decode()
        return Group(group.kind.decode(), group.instance.bits, group.solver, group.scale, numpy.array(group.position),
                     numpy.array(group.rotation, float), _copied(group.ids, group.count), units, columns)


class View(_Owned):
    """Draws a scene. @param settings members of FxViewSettings"""
    _destroy = staticmethod(fx.fxDestroyView)

    def __init__(self, context, scene, **settings):
        self._settings = assign(default("FxViewSettings"), settings)
        pointer = opaque("FxView")
        fx.fxCreateView(context._open(), scene.pointer, ctypes.byref(self._settings), ctypes.byref(pointer))
        self._scene = scene
        super().__init__(context, pointer)

    def set(self, **settings):
        """Changes members of FxViewSettings. A failed call changes nothing."""
        changed = assign(type(self._settings).from_buffer_copy(self._settings), settings)
        fx.fxView_SetSettings(self.pointer, ctypes.byref(changed))
        self._settings = changed

    def render(self, **frame):
        """Draws a frame. @param frame members of FxFrameDef: camera and target"""
        fx.fxView_Render(self.pointer, ctypes.byref(assign(default("FxFrameDef"), frame)))

    def statistics(self):
        """FxViewStatistics."""
        return filled("FxViewStatistics", fx.fxView_GetStatistics, self.pointer)


def _with_camera(members, set_camera, *arguments):
    """Members of FxFrameDef, and those that a function of the C API sets."""
    frame = assign(default("FxFrameDef"), members)
    set_camera(*arguments, ctypes.byref(frame))
    return dict(members, origin=frame.origin, view=frame.view, projection=frame.projection)


def _copied(pointer, count):
    """A numpy array of `count` values; an empty one where the pointer is null."""
    if not pointer or count == 0:
        return numpy.empty(0, numpy.float32)
    return numpy.ctypeslib.as_array(pointer, (count,)).copy()


def _open_country(width, height, camera, light):
    """Level ground under a sky, for a camera of Context.camera(): exposed colors, linear, and depths."""
    slope = 1.0 / camera["projection"][5]
    x = slope * width / height * ((numpy.arange(width) + 0.5) / width * 2.0 - 1.0)
    y = slope * (1.0 - (numpy.arange(height) + 0.5) / height * 2.0)
    axes = numpy.array(camera["view"]).reshape(4, 4)[:3, :3]  # columns of the view are axes of the eye along the world's
    rays = x[None, :, None] * axes[:, 0] + y[:, None, None] * axes[:, 1] - axes[:, 2]
    falls = -rays[:, :, 1]
    with numpy.errstate(divide="ignore"):
        away = numpy.where(falls > 0.0, camera["origin"][1] / falls, numpy.inf)  # [m] along the view
    is_ground = (away > _NEAR) & numpy.isfinite(away)
    sun, sky = numpy.array(light["sunIlluminance"]), numpy.array(light["skyLuminance"])
    soil = light["groundAlbedo"] * numpy.array((1.1, 1.0, 0.85)) * (sun * max(light["sunDirection"][1], 0.0) / math.pi + sky)
    up = numpy.clip(rays[:, :, 1] / numpy.linalg.norm(rays, axis=2), 0.0, 1.0)[:, :, None]
    luminance = numpy.where(is_ground[:, :, None], soil, sky * (1.2 - 0.7 * numpy.sqrt(up)))
    return luminance / (1.2 * 2.0 ** light["exposureEv100"]), numpy.where(is_ground, 1.0 - _NEAR / numpy.maximum(away, _NEAR), 1.0)


def _camera_of(scene, instance, size):
    """A camera that sees the instance; where it shows nothing yet, one for an effect of a meter."""
    try:
        return scene.camera(instance, *size)
    except Error as error:
        if error.name != "not-found":
            raise
        return scene._context.camera((0.0, 0.3, 2.6), (0.0, 0.0, 0.0), *size)


def render(preset, time=None, size=(640, 360), eye=None, target=None, exposure=None, **settings):
    """A picture of an effect in open country, without a window, in the light for which its author made it.

    @param preset   as for Context.load()
    @param time     [s] of the effect; None: that of its preview
    @param size     [pixel] width and height
    @param eye      [m] position of the camera; None: that of its preview, or where the effect fills the picture
    @param target   [m] where the camera looks; None if and only if `eye` is None
    @param exposure [EV100]; None: that of its preview
    @param settings members of FxViewSettings
    @return array of height x width x 3 bytes, rows from the top
    """
    if len(size) != 2 or not all(1 <= side <= 16384 and side == int(side) for side in size):
        raise ValueError(f"size is {size}; allowed are two whole numbers of pixels from 1 to 16384")
    if (eye is None) != (target is None):
        raise ValueError("eye and target belong together: give both, or none")
    with Offscreen() as gl, Context(gl.address) as context:
        scene = context.scene()
        instance = scene.add(preset)
        scene.update(context.preview(preset).time if time is None else time)
        camera = context.camera(eye, target, *size) if eye is not None else _camera_of(scene, instance, size)
        shown = dict(context.preview_settings(preset), toneMap=1)
        if exposure is not None:
            shown["exposureEv100"] = exposure
        view = context.view(scene, **{**shown, **settings})
        picture = gl.picture(*size)
        colors, depths = _open_country(*size, camera, {**shown, **settings})
        picture.fill(colors)
        picture.fill_depth(depths)
        view.render(colorTexture=picture.name, depthTexture=picture.depth, **camera)
        pixels = picture.read()
        picture.close()
    return (255.0 * numpy.clip(numpy.nan_to_num(pixels), 0.0, 1.0) + 0.5).astype(numpy.uint8)


def write_png(path, pixels):
    """Writes an array of height x width x 3 bytes as a PNG file."""
    height, width, channels = pixels.shape
    if pixels.dtype != numpy.uint8 or channels != 3:
        raise ValueError("write_png takes height x width x 3 bytes")
    rows = numpy.concatenate([numpy.zeros((height, 1), numpy.uint8), pixels.reshape(height, 3 * width)], axis=1)

    def chunk(name, data):
        return _binary.pack(">I", len(data)) + name + data + _binary.pack(">I", zlib.crc32(name + data))

    header = _binary.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)  # 8 bits, red, green and blue
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows.tobytes()))
                   + chunk(b"IEND", b""))
