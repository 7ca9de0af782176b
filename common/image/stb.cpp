// The implementation of stb_image_write, in a file of its own, since it is not ours to check.

#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>
