/// @file kernel_shapes.inl
/// The shapes w(q) of the kernels of sph_kernel.h, for every type that has +, -, *, /, larger(a, b) and
/// smaller(a, b) and can be made of a double. Included once for scalars and once for each instruction set,
/// in the namespace of the includer: the text of the formulas exists once.
///
/// Each has the constant C, w(0), the value w(q) and the slope w'(q) / q, for q in [0, 1]. The slope over q
/// is finite at 0, so that coincident particles need no division.

/// @copydoc sph-kernels (2)
struct WendlandC2Shape
{
    static constexpr double kNorm = 3.3422538049298023; // 21 / (2 pi)
    static constexpr double kCenter = 1.0;
    template <class N>
    static N value(N q)
    {
        const N t = N(1.0) - q;
        const N t2 = t * t;
        return t2 * t2 * (N(1.0) + N(4.0) * q);
    }
    template <class N>
    static N slope(N q)
    {
        const N t = N(1.0) - q;
        return N(-20.0) * (t * t * t);
    }
};

/// @copydoc sph-kernels (3)
struct WendlandC4Shape
{
    static constexpr double kNorm = 4.923856051905513; // 495 / (32 pi)
    static constexpr double kCenter = 1.0;
    template <class N>
    static N value(N q)
    {
        const N t = N(1.0) - q;
        const N t2 = t * t;
        return t2 * t2 * t2 * (N(1.0) + q * (N(6.0) + N(35.0 / 3.0) * q));
    }
    template <class N>
    static N slope(N q)
    {
        const N t = N(1.0) - q;
        const N t2 = t * t;
        return N(-56.0 / 3.0) * (t2 * t2 * t) * (N(1.0) + N(5.0) * q);
    }
};

/// @copydoc sph-kernels (4)
struct CubicSplineShape
{
    static constexpr double kNorm = 5.092958178940651; // 16 / pi
    static constexpr double kCenter = 0.5;
    template <class N>
    static N value(N q)
    {
        const N t = N(1.0) - q;
        const N u = larger(N(0.5) - q, N(0.0));
        return t * t * t - N(4.0) * (u * u * u);
    }
    template <class N>
    static N slope(N q)
    {
        const N p = larger(q, N(0.5)); // the outer branch, continued by a straight line
        const N t = N(1.0) - p;
        return N(-3.0) * (t * t) / p - N(9.0) * (p - q);
    }
};

/// @copydoc sph-kernels (5)
struct QuarticShape
{
    static constexpr double kNorm = 1.0444543140405632; // 105 / (32 pi)
    static constexpr double kCenter = 1.0;
    template <class N>
    static N value(N q)
    {
        const N s = N(1.0) - q * q;
        return s * s;
    }
    template <class N>
    static N slope(N q)
    {
        return N(-4.0) * (N(1.0) - q * q);
    }
};

/// @copydoc sph-kernels (5)
struct SexticShape
{
    static constexpr double kNorm = 1.5666814710608448; // 315 / (64 pi)
    static constexpr double kCenter = 1.0;
    template <class N>
    static N value(N q)
    {
        const N s = N(1.0) - q * q;
        return s * s * s;
    }
    template <class N>
    static N slope(N q)
    {
        const N s = N(1.0) - q * q;
        return N(-6.0) * (s * s);
    }
};

/// @copydoc sph-kernels (5)
struct OcticShape
{
    static constexpr double kNorm = 2.1541870227086614; // 3465 / (512 pi)
    static constexpr double kCenter = 1.0;
    template <class N>
    static N value(N q)
    {
        const N s = N(1.0) - q * q;
        const N s2 = s * s;
        return s2 * s2;
    }
    template <class N>
    static N slope(N q)
    {
        const N s = N(1.0) - q * q;
        return N(-8.0) * (s * s * s);
    }
};

/// Calls f with the shape of `kernel`: the switch stands outside of every loop.
template <class F>
inline void withShape(SphKernel kernel, F&& f)
{
    switch (kernel) {
    case SphKernel::WendlandC2:
        return f(WendlandC2Shape());
    case SphKernel::WendlandC4:
        return f(WendlandC4Shape());
    case SphKernel::CubicSpline:
        return f(CubicSplineShape());
    case SphKernel::Quartic:
        return f(QuarticShape());
    case SphKernel::Sextic:
        return f(SexticShape());
    case SphKernel::Octic:
        return f(OcticShape());
    }
}
