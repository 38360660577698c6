// SPDX-License-Identifier: MIT
#include "framework/certify/jet.h"

namespace kaustik::certify {

Interval TaylorModel::range() const {
    // Corners of the cell are the ends of what is linear.
    const double low = std::min({value, value + slope[0], value + slope[1]});
    const double high = std::max({value, value + slope[0], value + slope[1]});
    const double failure = (slope[0] + slope[1]) * 0.0;
    return Interval(rounding::down(low), rounding::up(high)) + rest + Interval(failure);
}

TaylorModel modelOf(const Jet<false>& middle, const Jet<true>& square) {
    // With d the step from the middle: dx² is from 0 to 4/9 with mean 1/18, dx dy from -2/9 to 1/9
    // with mean -1/36 and, in absolute value, a mean of at most 1/18.
    const Interval third = Interval(1.0) / Interval(3.0);
    const Interval squares(0.0, 0.4444444444444446);
    const Interval products(-0.2222222222222223, 0.1111111111111112);
    TaylorModel model;
    const Interval xx = 0.5 * square.hessian[0];
    const Interval xy = square.hessian[1];
    const Interval yy = 0.5 * square.hessian[2];
    // Along each axis the square has the smaller factor of both ends with 0.
    model.rest = xx * squares + xy * products + yy * squares;
    const Interval eighteenth = Interval(1.0) / Interval(18.0);
    const Interval around = xy - Interval(xy.middle());
    const double spread = rounding::up(around.magnitude() * 0.0555555555555557);
    const Interval crossMean =
        Interval(xy.middle()) * (-0.5 * eighteenth) + Interval(-spread, spread);
    model.restMean = (xx + yy) * eighteenth + crossMean;
    // The slopes are numbers; by how much the gradient may differ goes to the rest.
    Interval slack(0.0);
    for (std::size_t i = 0; i < 2; ++i) {
        model.slope[i] = middle.gradient[i].middle();
        slack = slack + (middle.gradient[i] - Interval(model.slope[i])) * Interval(-0.34, 0.67);
    }
    const Interval atMiddle = middle.value;
    const Interval origin =
        atMiddle - (Interval(model.slope[0]) + Interval(model.slope[1])) * third;
    model.value = origin.middle();
    slack = slack + (origin - Interval(model.value));
    // Sums of value, slope and place are rounded where they are used.
    const double rounded =
        0x1p-49 * (std::fabs(model.value) + std::fabs(model.slope[0]) + std::fabs(model.slope[1]));
    slack = slack + Interval(-rounded, rounded);
    // Whoever has no value over the cell has no derivatives either, whatever they say.
    slack = slack + Interval((square.value.lo + square.value.hi) * 0.0);
    model.rest = model.rest + slack;
    model.restMean = model.restMean + slack;
    return model;
}

// No number on either side leaves the other as it is (intersection).
void narrow(const Jet<false>& middle, Jet<true>& cell) {
    const Interval step(-0.33333333333333337, 0.66666666666666674);
    for (std::size_t i = 0; i < 2; ++i) {
        cell.gradient[i] =
            intersection(cell.gradient[i],
                         middle.gradient[i] + step * cell.hessian[i] + step * cell.hessian[i + 1]);
    }
    cell.value = intersection(cell.value, modelOf(middle, cell).range());
}

}  // namespace kaustik::certify
