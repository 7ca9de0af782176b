#pragma once

#include "scene/xml_source.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace carlo {

/// A thing's names in Mitsuba 0.6 and in Mitsuba 2 and 3.
struct Name {
  std::string_view mitsuba06, mitsuba3;
};

/// The properties whose names differ. Every file may use either name; this library uses the first.
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

/// The first name of a property; `name` itself if it has only one, or is unknown.
std::string mitsuba06_name(std::string_view name);

/// The name in files of `dialect` of the property that Mitsuba 0.6 calls `name`.
std::string name_in(Dialect dialect, std::string_view name);

/// The dialect of a <scene version="...">; nothing for an unsupported version.
std::optional<Dialect> dialect_of(std::string_view version);

}  // namespace carlo
