/// @file chi_square.h
/// Chi-square test whether counts agree with given probabilities.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace fx::test {

/// Counts of samples in cells of equal probability.
class EqualCells
{
public:
    explicit EqualCells(size_t cells) : counts_(cells) {}
    void add(double share) ///< of the distribution that lies below the sample, 0..1
    {
        const double cell = share * double(counts_.size());
        ++counts_[cell > 0.0 ? std::min(size_t(cell), counts_.size() - 1) : 0];
    }
    void addCell(size_t cell) { ++counts_.at(cell); }

    double chiSquare() const
    {
        uint64_t all = 0;
        for (const uint64_t n : counts_)
            all += n;
        const double want = double(all) / double(counts_.size());
        double sum = 0;
        for (const uint64_t n : counts_)
            sum += (double(n) - want) * (double(n) - want) / want;
        return sum;
    }
    double degrees() const { return double(counts_.size() - 1); }

private:
    std::vector<uint64_t> counts_;
};

/// Value that chi-square with `degrees` degrees of freedom exceeds with the probability with which the normal
/// distribution exceeds z, by the approximation of Wilson and Hilferty.
inline double chiSquareLimit(double degrees, double z)
{
    const double part = 2.0 / (9.0 * degrees);
    return degrees * std::pow(1.0 - part + z * std::sqrt(part), 3.0);
}

/// 1 % for all tests of the shapes together (Sidak, 40 tests): each 1 - 0.99^(1/40) = 2.5e-4, z = 3.48.
constexpr double kSidak = 3.48;

inline void expectEven(const EqualCells& cells, const char* what)
{
    EXPECT_LT(cells.chiSquare(), chiSquareLimit(cells.degrees(), kSidak)) << what;
}

} // namespace fx::test
