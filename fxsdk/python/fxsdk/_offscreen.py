"""OpenGL 4.5 without a window, by EGL, and the texture that effects are drawn into. For hosts without OpenGL of their own.

Threads: all calls on the thread that created the Offscreen.
"""
import ctypes

import numpy

_SURFACELESS_MESA = 0x31DD
_OPENGL_API = 0x30A2
_CONTEXT_45_CORE = (0x3098, 4, 0x30FB, 5, 0x30FD, 1, 0x3038)  # major version, minor version, core profile, end
_DEPTH32F, _DEPTH = 0x8CAC, 0x1902
_TEXTURE_2D, _RGBA32F, _RGBA, _RGB, _FLOAT, _PACK_ALIGNMENT = 0x0DE1, 0x8814, 0x1908, 0x1907, 0x1406, 0x0D05


class Offscreen:
    """A current context of OpenGL 4.5 without a surface."""

    def __init__(self):
        try:
            self._egl = ctypes.CDLL("libEGL.so.1")
        except OSError:
            raise RuntimeError("drawing needs libEGL.so.1: install libegl1 and libgl1-mesa-dri") from None
        for name in ("eglGetProcAddress", "eglGetDisplay", "eglCreateContext"):
            getattr(self._egl, name).restype = ctypes.c_void_p
        self._egl.eglGetProcAddress.argtypes = [ctypes.c_char_p]
        self._display = self._open_display()
        attributes = (ctypes.c_int * len(_CONTEXT_45_CORE))(*_CONTEXT_45_CORE)
        self._egl.eglBindAPI(_OPENGL_API)
        self._context = self._egl.eglCreateContext(self._display, None, None, attributes)
        if not self._context or not self._egl.eglMakeCurrent(self._display, None, None, ctypes.c_void_p(self._context)):
            raise RuntimeError("EGL has no OpenGL 4.5 core context without a surface")

    def _open_display(self):
        """A display that needs no screen, or the default one."""
        platform = self.address(b"eglGetPlatformDisplayEXT")
        if platform:
            get = ctypes.CFUNCTYPE(ctypes.c_void_p, ctypes.c_uint, ctypes.c_void_p, ctypes.c_void_p)(platform)
            display = ctypes.c_void_p(get(_SURFACELESS_MESA, None, None))
            if display and self._egl.eglInitialize(display, None, None):
                return display
        display = ctypes.c_void_p(self._egl.eglGetDisplay(None))
        if not display or not self._egl.eglInitialize(display, None, None):
            raise RuntimeError("no EGL display: install libegl1 and libgl1-mesa-dri")
        return display

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def address(self, name):
        """Of a function of OpenGL; for Context(gl=...). @param name as bytes"""
        return self._egl.eglGetProcAddress(name)

    def picture(self, width, height):
        """A texture of RGBA floats, for FxFrameDef::colorTexture. @param width, height [pixel]"""
        return Picture(self, width, height)

    def call(self, name, *arguments):
        """Calls a function of OpenGL without a result. Integers are passed as int, sequences as pointers."""
        function = ctypes.CFUNCTYPE(None, *(type(argument) for argument in arguments))(self.address(name.encode()))
        function(*arguments)

    def close(self):
        if self._context:
            self._egl.eglMakeCurrent(self._display, None, None, None)
            self._egl.eglDestroyContext(self._display, ctypes.c_void_p(self._context))
            self._context = None


class Picture:
    """A texture of RGBA floats."""

    def __init__(self, gl, width, height):
        self._gl, self.width, self.height = gl, width, height
        self.name, self.depth = self._texture(_RGBA32F), 0

    def _texture(self, format):
        name = ctypes.c_uint()
        self._gl.call("glCreateTextures", ctypes.c_uint(_TEXTURE_2D), ctypes.c_int(1), ctypes.pointer(name))
        self._gl.call("glTextureStorage2D", name, ctypes.c_int(1), ctypes.c_uint(format), ctypes.c_int(self.width),
                      ctypes.c_int(self.height))
        return name.value

    def clear(self, color):
        """@param color exposed, linear red, green and blue"""
        rgba = (ctypes.c_float * 4)(*color, 1.0)
        self._gl.call("glClearTexImage", ctypes.c_uint(self.name), ctypes.c_int(0), ctypes.c_uint(_RGBA),
                      ctypes.c_uint(_FLOAT), ctypes.cast(rgba, ctypes.c_void_p))

    def fill(self, colors):
        """@param colors height x width x 3, exposed, linear red, green and blue, rows from the top"""
        rgba = numpy.ones((self.height, self.width, 4), numpy.float32)
        rgba[:, :, :3] = colors[::-1]
        self._upload(self.name, _RGBA, rgba)

    def fill_depth(self, depths):
        """Makes the texture `depth`, of what is before the effects. @param depths [0, 1] height x width, rows from the top"""
        if not self.depth:
            self.depth = self._texture(_DEPTH32F)
        self._upload(self.depth, _DEPTH, numpy.ascontiguousarray(depths[::-1], numpy.float32))

    def _upload(self, name, channels, values):
        self._gl.call("glTextureSubImage2D", ctypes.c_uint(name), *(ctypes.c_int(x) for x in (0, 0, 0, self.width, self.height)),
                      ctypes.c_uint(channels), ctypes.c_uint(_FLOAT), ctypes.c_void_p(values.ctypes.data))

    def read(self):
        """The picture: an array of height x width x 3 floats, rows from the top."""
        pixels = numpy.empty((self.height, self.width, 3), numpy.float32)
        self._gl.call("glPixelStorei", ctypes.c_uint(_PACK_ALIGNMENT), ctypes.c_int(1))
        self._gl.call("glGetTextureImage", ctypes.c_uint(self.name), ctypes.c_int(0), ctypes.c_uint(_RGB),
                      ctypes.c_uint(_FLOAT), ctypes.c_int(pixels.nbytes), ctypes.c_void_p(pixels.ctypes.data))
        return pixels[::-1]

    def close(self):
        for name in filter(None, (self.name, self.depth)):
            self._gl.call("glDeleteTextures", ctypes.c_int(1), ctypes.pointer(ctypes.c_uint(name)))
        self.name = self.depth = 0
