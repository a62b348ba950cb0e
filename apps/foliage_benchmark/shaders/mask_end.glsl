#undef main
// What plants cover, beside their colour: the same samples, whatever becomes of alpha.
layout(location = 1) out float mask;

void main() {
  shade();
  mask = 1.0;
}
