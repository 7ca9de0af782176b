#!/usr/bin/env bash
# Embree 3.13.5 (Debian libembree3-3), rtcOccluded16 with half of `valid` 0.
# Expected: rays whose `valid` is 0 are left alone, as the manual says.
# Seen: with "isa=avx512" they are. With sse2, sse4.2, avx and avx2, all 16 are traced: rays that were
# not asked for have tfar = -infinity afterwards. So a program that was tried on a machine
# with AVX-512 does up to twice the work on another, and reads rays that it never filled in; Debian's
# library checks its assertions for them, too. Packets of 4 with sse4.2 and of 8 with avx2 honour
# `valid`, and Embree 4.4.0 (in PyPI's embreex 4.4.0.post1, not run here) does in all cases.
# Do: give rays that are not wanted an empty segment (tnear > tfar).
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
debian_with libembree-dev=3.13.5+dfsg-2 libembree3-3=3.13.5+dfsg-2 libtbb12=2021.8.0-2+deb12u1 \
    libtbbmalloc2=2021.8.0-2+deb12u1 libtbbbind-2-5=2021.8.0-2+deb12u1 libhwloc15=2.9.0-1

cat > packets.cpp <<'CPP'
#include <embree3/rtcore.h>
#include <cmath>
#include <string>
#include "hold.h"
RTCScene triangle(RTCDevice device) {
    RTCScene scene = rtcNewScene(device);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* p = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, 3));
    const float corners[9] = {-1, -1, 0, 1, -1, 0, 0, 1, 0};
    for (int i = 0; i < 9; ++i) p[i] = corners[i];
    auto* t = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, 1));
    for (unsigned i = 0; i < 3; ++i) t[i] = i;
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcCommitScene(scene);
    return scene;
}
// All n rays point at the triangle; the first half is valid. How many are occluded afterwards.
template <int n, class Ray, class Trace>
int occluded(const std::string& isa, const Trace& trace) {
    RTCDevice device = rtcNewDevice(("isa=" + isa).c_str());
    RTCScene scene = triangle(device);
    alignas(64) int valid[n];
    alignas(64) Ray rays{};
    for (int i = 0; i < n; ++i) {
        valid[i] = i < n / 2 ? -1 : 0;
        rays.org_x[i] = 0.01f * static_cast<float>(i), rays.org_z[i] = 1;
        rays.dir_z[i] = -1, rays.tfar[i] = 5, rays.mask[i] = ~0u;
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    trace(valid, scene, &context, &rays);
    int count = 0;
    for (int i = 0; i < n; ++i) count += std::isinf(rays.tfar[i]) ? 1 : 0;
    std::printf("%d rays, %d of them valid, %s: %d occluded\n", n, n / 2, isa.c_str(), count);
    return count;
}
int main() {
    for (const char* isa : {"sse2", "sse4.2", "avx", "avx2"})
        hold(occluded<16, RTCRay16>(isa, rtcOccluded16) == 16, "16 rays: `valid` is honoured");
    if (__builtin_cpu_supports("avx512vl"))
        hold(occluded<16, RTCRay16>("avx512", rtcOccluded16) == 8, "AVX-512 honours `valid`");
    hold(occluded<4, RTCRay4>("sse4.2", rtcOccluded4) == 2, "4 rays honour `valid`");
    hold(occluded<8, RTCRay8>("avx2", rtcOccluded8) == 4, "8 rays honour `valid`");
}
CPP
g++ -std=c++17 -O1 -Iroot/usr/include packets.cpp -o packets root/usr/lib/*/libembree3.so.3 \
    -Wl,--unresolved-symbols=ignore-in-shared-libs
LD_LIBRARY_PATH=$(echo root/usr/lib/*-linux-gnu) ./packets
