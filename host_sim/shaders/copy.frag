// A picture as it is: what the frame budgets on software GL are multiples of.
layout(location = 0) out vec4 out_colour;
layout(binding = 0) uniform sampler2D u_picture;
void main() { out_colour = texelFetch(u_picture, ivec2(gl_FragCoord.xy), 0); }
