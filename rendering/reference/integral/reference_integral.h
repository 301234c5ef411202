/// @file reference_integral.h
/// The ray integral by adaptive quadrature of its definition. This slow code serves to check the fast code.
/// Both codes share no polynomials, coefficients or schemes.
#pragma once

#include "rendering/reference/integral/quadrature.h"
#include "rendering/reference/integral/ray_records.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace fx::render {

/// @formula reference-ray-integral
/// Light and optical depth along a ray by adaptive quadrature.
///
/// symbol   unit   meaning
///   w_i     m      half the chord of blob i
///   u       1      ray parameter relative to the center of the chord, in units of w_i, clamped to [-1, 1]
///   F_n(u)  1      integral of (1 - v^2)^n over v from 0 to u
///   G(a,b)  cd/m2  quadrature of light with ten Gauss nodes on [a, b]
/// @derivation
///   tau(t) = sum over i of extinction_i (w_i/R_i)^(2 n) w_i (F_n(u_i(t)) - F_n(u_i(t_0)))          (1)
///   I = integral of e^-tau(t) s(t) dt + e^-tau(t_1) background, divided where blobs begin and end   (2)
///   a piece [a, b] with midpoint m is halved until |G(a,m) + G(m,b) - G(a,b)| is within tolerance   (3)
/// @source    [UBT96] eq. (2) for the integral; quadrature is textbook
/// @deviation none
/// @valid     any number of blobs; cost grows with their square
/// @accuracy  the tolerance, relative to the light; tested against closed forms
/// @tests     tests/rendering/reference/integral/test_reference_integral.cpp
template <class T, class Exp>
class ReferenceIntegral
{
public:
    /// @param degree degree of the kernel
    /// @param exponential function that returns e^x for the type T
    ReferenceIntegral(std::span<const RayBlob<T>> blobs, const RayWindow<T>& window, uint32_t degree,
                      bool isProduct, T tolerance, T (*squareRoot)(T), Exp exponential)
        : blobs_(blobs.begin(), blobs.end()), window_(window), degree_(degree), isProduct_(isProduct),
          tolerance_(tolerance), exp_(exponential)
    {
        for (uint32_t i = 0; i < kNodes; ++i) {
            const auto [x, w] = integral::gaussNode<integral::Precise<T>>(kNodes, i);
            node_[i] = static_cast<T>(x);
            weight_[i] = static_cast<T>(w);
        }
        for (const RayBlob<T>& blob : blobs_)
            half_.push_back(blob.chord2 > T(0) ? squareRoot(blob.chord2) : T(0));
    }

    /// [cd/m2] Radiance in the three channels.
    std::array<T, 3> light()
    {
        std::vector<T> cuts;
        for (size_t i = 0; i < blobs_.size(); ++i)
            for (const T t : {blobs_[i].center - half_[i], blobs_[i].center + half_[i]})
                if (half_[i] > T(0))
                    cuts.push_back(std::min(std::max(t, window_.nearest), window_.farthest));
        std::sort(cuts.begin(), cuts.end());
        std::array<T, 3> sum{};
        T depth = T(0);
        if (!cuts.empty()) {
            const T whole = opticalDepth(cuts.front(), cuts.back());
            brightest_ = largestLight(whole);
            for (size_t i = 0; i + 1 < cuts.size(); ++i)
                if (cuts[i] < cuts[i + 1]) {
                    add(sum, cuts[i], cuts[i + 1], depth, gauss(cuts[i], cuts[i + 1], depth), 0);
                    depth += opticalDepth(cuts[i], cuts[i + 1]);
                }
        }
        for (int c = 0; c < 3; ++c)
            sum[c] += exp_(T(0) - depth) * window_.background[c];
        return sum;
    }

    /// Optical depth between two ray parameters, by equation (1).
    T opticalDepth(T begin, T end) const
    {
        T sum = T(0);
        for (size_t i = 0; i < blobs_.size(); ++i)
            if (half_[i] > T(0)) {
                const RayBlob<T>& blob = blobs_[i];
                const T scale = power(blob.chord2 / (blob.radius * blob.radius)) * half_[i] * blob.extinction;
                sum += scale * (primitive(place(i, end)) - primitive(place(i, begin)));
            }
        return sum;
    }

private:
    static constexpr uint32_t kNodes = 10;
    static constexpr int kDeepest = 40;

    T place(size_t i, T t) const
    {
        return std::min(std::max((t - blobs_[i].center) / half_[i], T(-1)), T(1));
    }
    T power(T x) const { return degree_ == 2 ? x * x : degree_ == 3 ? x * x * x : x * x * x * x; }
    T primitive(T u) const
    {
        const T v = u * u;
        if (degree_ == 2)
            return u * (T(1) - v * (T(2) / T(3) - v / T(5)));
        if (degree_ == 3)
            return u * (T(1) - v * (T(1) - v * (T(3) / T(5) - v / T(7))));
        return u * (T(1) - v * (T(4) / T(3) - v * (T(6) / T(5) - v * (T(4) / T(7) - v / T(9)))));
    }
    std::array<T, 3> sourceAt(T t) const
    {
        std::array<T, 3> sum{};
        T extinction = T(0);
        for (const RayBlob<T>& blob : blobs_) {
            const T d = t - blob.center;
            const T inside = blob.chord2 - d * d;
            if (!(inside > T(0)))
                continue;
            const T kernel = power(inside / (blob.radius * blob.radius));
            extinction += kernel * blob.extinction;
            for (int c = 0; c < 3; ++c)
                sum[c] += kernel * (isProduct_ ? T(1) : blob.extinction) * blob.source[c];
        }
        if (isProduct_)
            for (T& channel : sum)
                channel *= extinction;
        return sum;
    }
    T largestLight(T depth) const
    {
        T most = T(0);
        for (const RayBlob<T>& blob : blobs_)
            most = std::max(most, std::max(blob.source[0], std::max(blob.source[1], blob.source[2])));
        return most * std::min(depth, T(1));
    }
    std::array<T, 3> gauss(T begin, T end, T before) const
    {
        const T half = (end - begin) / T(2), middle = begin + half;
        std::array<T, 3> sum{};
        for (uint32_t i = 0; i < kNodes; ++i) {
            const T t = middle + half * node_[i];
            const T passed = exp_(T(0) - (before + opticalDepth(begin, t))) * weight_[i] * half;
            const std::array<T, 3> source = sourceAt(t);
            for (int c = 0; c < 3; ++c)
                sum[c] += passed * source[c];
        }
        return sum;
    }
    /// Adds the light of an interval to `io`, by equation (3).
    void add(std::array<T, 3>& io, T begin, T end, T before, const std::array<T, 3>& whole, int level) const
    {
        const T middle = begin + (end - begin) / T(2);
        const T later = before + opticalDepth(begin, middle);
        const std::array<T, 3> left = gauss(begin, middle, before), right = gauss(middle, end, later);
        T error = T(0);
        for (int c = 0; c < 3; ++c) {
            const T difference = left[c] + right[c] - whole[c];
            error = std::max(error, difference < T(0) ? T(0) - difference : difference);
        }
        if (level == kDeepest || !(error > tolerance_ * brightest_)) {
            for (int c = 0; c < 3; ++c)
                io[c] += left[c] + right[c];
            return;
        }
        add(io, begin, middle, before, left, level + 1);
        add(io, middle, end, later, right, level + 1);
    }

    std::vector<RayBlob<T>> blobs_;
    std::vector<T> half_;
    RayWindow<T> window_;
    uint32_t degree_;
    bool isProduct_;
    T tolerance_;
    T brightest_ = T(0);
    Exp exp_;
    std::array<T, kNodes> node_{}, weight_{};
};

} // namespace fx::render
