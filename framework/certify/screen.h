// SPDX-License-Identifier: MIT
// Where a beam's light on a facet is seen, in homogeneous coordinates, so that nothing is divided
// by and light along the facet's plane is no trouble.
//
// With c = N·d the cosine (times the area) at which the beam closes in on the plane, h = N·(a - o)
// the height of its origin, and e the eye, the point that is met is o + (h/c) d, and
//
//     c (o - e) + h d
//
// is c times its place from the eye. Depth, column and row times depth are linear in that. Columns
// and rows are counted from a point in the middle of the image, whose own second order cancels.
#pragma once

#include "framework/certify/eye_view.h"
#include "framework/certify/ray.h"

namespace kaustik::certify {

class Screen {
  public:
    // `along`: the sign of direction · normal on the way to `goal`. `may`: what of the beam may
    // meet it.
    Screen(const EyeView& eye, const Ray& ray, const Facet& goal, double along,
           const Polygons& may);

    [[nodiscard]] bool isFinite() const {
        return column_.isFinite() && row_.isFinite() && depth_.isFinite();
    }
    // Whether something of it may be behind the eye; beforeEye() takes that away. All else here is
    // of what is before the eye.
    [[nodiscard]] bool mayBeBehind() const { return depthRange_.lo <= 0.0; }
    [[nodiscard]] HalfPlane beforeEye() const { return lineOf(depth_, 1.0); }
    // Where value + slopeX column + slopeY row + (something from low to high) >= 0 on the screen.
    [[nodiscard]] HalfPlane edge(double slopeX, double slopeY, double value, double low,
                                 double high) const;
    // Whether the depths times cosines are so different that places have no common error in pixels.
    [[nodiscard]] bool isSlanted() const { return !(depthRange_.lo > 0.2 * depthRange_.hi); }
    // By how many pixels places are unsure within these pixels, where it is not slanted.
    [[nodiscard]] double band(const EyeView::Extent& pixels) const;
    // The pixels of the extent in which the polygons may be seen; empty where none.
    [[nodiscard]] EyeView::Extent pixelsIn(const Polygons& polygons,
                                           const EyeView::Extent& extent) const;

  private:
    double columnMiddle_ = 0.0;
    double rowMiddle_ = 0.0;
    TaylorModel column_;  // (column - columnMiddle_) depth_
    TaylorModel row_;
    TaylorModel depth_;
    Interval depthRange_;
};

}  // namespace kaustik::certify
