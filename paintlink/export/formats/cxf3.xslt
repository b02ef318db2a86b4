<?xml version="1.0" encoding="UTF-8"?>
<!--
  Color Exchange Format 3 (ISO 17972-1), multi-angle.

  Several angles in one colour specification could not tell which value belongs to which,
  so each angle has its own, and all values stand in one object. What the standard has no
  field for stands in the tag collection "paintlink".
-->
<xsl:stylesheet version="1.0"
                xmlns:xsl="http://www.w3.org/1999/XSL/Transform"
                xmlns:spec="urn:paintlink:color-specification:1"
                xmlns="http://colorexchangeformat.com/CxF3-core"
                exclude-result-prefixes="spec">

  <format xmlns="urn:paintlink:export-format:1"
          id="cxf3"
          label="Color Exchange Format 3 (CxF)"
          suffix="cxf"
          file-name="{date}_{name}"
          starting-paint="optional"/>

  <xsl:output method="xml" encoding="UTF-8" indent="yes"/>

  <xsl:param name="job-id"/>
  <xsl:param name="created-at"/>
  <xsl:param name="origin"/>
  <xsl:param name="copy"/>

  <xsl:template match="/spec:colorSpecification">
    <CxF>
      <FileInformation>
        <Creator>paintlink</Creator>
        <CreationDate><xsl:value-of select="$created-at"/></CreationDate>
        <Description>job <xsl:value-of select="$job-id"/></Description>
      </FileInformation>
      <Resources>
        <ObjectCollection>
          <Object ObjectType="Target" Name="{spec:name}" Id="colour">
            <CreationDate>
              <xsl:choose>
                <xsl:when test="spec:measurement"><xsl:value-of select="spec:measurement/spec:time"/></xsl:when>
                <xsl:otherwise><xsl:value-of select="$created-at"/></xsl:otherwise>
              </xsl:choose>
            </CreationDate>
            <ColorValues>
              <xsl:for-each select="spec:spectra/spec:spectrum">
                <ReflectanceSpectrum ColorSpecification="as{@aspecular}" Name="45as{@aspecular}" StartWL="{@start}">
                  <xsl:for-each select="spec:factor">
                    <xsl:if test="position() > 1"><xsl:text> </xsl:text></xsl:if>
                    <xsl:value-of select="."/>
                  </xsl:for-each>
                </ReflectanceSpectrum>
              </xsl:for-each>
              <xsl:for-each select="spec:samples/spec:sample">
                <ColorCIELab ColorSpecification="as{@aspecular}" Name="45as{@aspecular}">
                  <L><xsl:value-of select="@L"/></L>
                  <A><xsl:value-of select="@a"/></A>
                  <B><xsl:value-of select="@b"/></B>
                </ColorCIELab>
              </xsl:for-each>
            </ColorValues>
            <TagCollection Name="paintlink">
              <Tag Name="origin" Value="{$origin}"/>
              <Tag Name="finish" Value="{spec:finish}"/>
              <xsl:if test="spec:code"><Tag Name="code" Value="{spec:code}"/></xsl:if>
              <xsl:if test="spec:startingPaint"><Tag Name="startingPaint" Value="{spec:startingPaint/spec:code}"/></xsl:if>
              <xsl:if test="spec:measurement/spec:dataMode"><Tag Name="dataMode" Value="{spec:measurement/spec:dataMode}"/></xsl:if>
              <xsl:if test="spec:measurement/spec:averaged"><Tag Name="averaged" Value="{spec:measurement/spec:averaged}"/></xsl:if>
            </TagCollection>
            <xsl:apply-templates select="spec:gloss"/>
          </Object>
        </ObjectCollection>
        <ColorSpecificationCollection>
          <xsl:for-each select="spec:samples/spec:sample">
            <ColorSpecification Id="as{@aspecular}">
              <TristimulusSpec>
                <Illuminant><xsl:value-of select="../@illuminant"/></Illuminant>
                <Observer><xsl:value-of select="concat(../@observer, '_Degree')"/></Observer>
                <Method>E308_Table5</Method>
              </TristimulusSpec>
              <xsl:call-template name="measured"/>
            </ColorSpecification>
          </xsl:for-each>
          <!-- A spectrum at an angle that has no Lab: a solid measured at one angle. -->
          <xsl:for-each select="spec:spectra/spec:spectrum[not(@aspecular = ../../spec:samples/spec:sample/@aspecular)]">
            <ColorSpecification Id="as{@aspecular}">
              <xsl:call-template name="measured"/>
            </ColorSpecification>
          </xsl:for-each>
        </ColorSpecificationCollection>
      </Resources>
    </CxF>
  </xsl:template>

  <xsl:template match="spec:gloss">
    <PhysicalAttributes>
      <Gloss>
        <xsl:if test="@angle"><xsl:attribute name="Method"><xsl:value-of select="concat(@angle, ' degrees')"/></xsl:attribute></xsl:if>
        <xsl:value-of select="@value"/>
      </Gloss>
    </PhysicalAttributes>
  </xsl:template>

  <xsl:template name="measured">
    <xsl:variable name="color" select="/spec:colorSpecification"/>
    <xsl:variable name="spectrum" select="$color/spec:spectra/spec:spectrum[@aspecular = current()/@aspecular]"/>
    <MeasurementSpec>
      <MeasurementType>
        <xsl:choose>
          <xsl:when test="$spectrum">Spectrum_Reflectance</xsl:when>
          <xsl:otherwise>Colorimetric_Reflectance</xsl:otherwise>
        </xsl:choose>
      </MeasurementType>
      <GeometryChoice>
        <MultiAngle>
          <BRDFAngle Notation="45as{@aspecular}">
            <IlluminationAngle>45</IlluminationAngle>
            <Aspecular><xsl:value-of select="@aspecular"/></Aspecular>
          </BRDFAngle>
        </MultiAngle>
      </GeometryChoice>
      <xsl:if test="$spectrum">
        <WavelengthRange StartWL="{$spectrum/@start}" Increment="{$spectrum/@step}"/>
      </xsl:if>
      <xsl:if test="$color/spec:measurement">
        <Device>
          <Manufacturer><xsl:value-of select="$color/spec:measurement/spec:instrument/spec:maker"/></Manufacturer>
          <Model><xsl:value-of select="$color/spec:measurement/spec:instrument/spec:model"/></Model>
          <xsl:if test="$color/spec:measurement/spec:instrument/spec:serial">
            <SerialNumber><xsl:value-of select="$color/spec:measurement/spec:instrument/spec:serial"/></SerialNumber>
          </xsl:if>
        </Device>
      </xsl:if>
    </MeasurementSpec>
  </xsl:template>
</xsl:stylesheet>
