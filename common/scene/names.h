#pragma once

#include "scene/xml_source.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace carlo {

/// What Mitsuba 0.6 and Mitsuba 2 and 3 call the same thing.
struct Name {
  std::string_view mitsuba06, mitsuba3;
};

/// The properties whose names differ. Either name is understood in every file; within this library
/// each goes by the first.
inline constexpr auto property_names = std::to_array<Name>({
    {"attachLog", "attach_log"},
    {"componentFormat", "component_format"},
    {"cropHeight", "crop_height"},
    {"cropOffsetX", "crop_offset_x"},
    {"cropOffsetY", "crop_offset_y"},
    {"cropWidth", "crop_width"},
    {"diffuseReflectance", "diffuse_reflectance"},
    {"extIOR", "ext_ior"},
    {"faceNormals", "face_normals"},
    {"farClip", "far_clip"},
    {"fileFormat", "file_format"},
    {"flipNormals", "flip_normals"},
    {"flipTexCoords", "flip_tex_coords"},
    {"focalLength", "focal_length"},
    {"focusDistance", "focus_distance"},
    {"fovAxis", "fov_axis"},
    {"hideEmitters", "hide_emitters"},
    {"highQualityEdges", "high_quality_edges"},
    {"intIOR", "int_ior"},
    {"maxDepth", "max_depth"},
    {"nearClip", "near_clip"},
    {"pixelFormat", "pixel_format"},
    {"principalPointOffsetX", "principal_point_offset_x"},
    {"principalPointOffsetY", "principal_point_offset_y"},
    {"rrDepth", "rr_depth"},
    {"sampleBorder", "sample_border"},
    {"sampleCount", "sample_count"},
    {"samplingWeight", "sampling_weight"},
    {"shutterClose", "shutter_close"},
    {"shutterOpen", "shutter_open"},
    {"specularReflectance", "specular_reflectance"},
    {"specularTransmittance", "specular_transmittance"},
    {"toWorld", "to_world"},
});

/// The first name of a property; `name` itself if it has only one, or is none.
std::string mitsuba06_name(std::string_view name);

/// What files of `dialect` call the property that Mitsuba 0.6 calls `name`.
std::string name_in(Dialect dialect, std::string_view name);

/// The dialect of a <scene version="...">; nothing for a version that is not read.
std::optional<Dialect> dialect_of(std::string_view version);

}  // namespace carlo
