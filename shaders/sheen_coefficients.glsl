// The five numbers of Conty and Kulla's l(), which depend on the roughness alone.
struct SheenCoefficients {
    float a;
    float b;
    float c;
    float d;
    float e;
};
