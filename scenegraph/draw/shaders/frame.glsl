layout(std140, binding = 0) uniform FrameBlock { FrameData frame; };
