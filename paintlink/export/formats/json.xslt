<?xml version="1.0" encoding="UTF-8"?>
<!--
  The whole colour specification as one JSON object, for scripts and web services.

  Numbers are copied digit by digit from the specification, never converted. Only tab,
  line feed, carriage return, quotation mark and backslash need escaping: a
  specification holds no other control character.
-->
<xsl:stylesheet version="1.0"
                xmlns:xsl="http://www.w3.org/1999/XSL/Transform"
                xmlns:spec="urn:paintlink:color-specification:1">

  <format xmlns="urn:paintlink:export-format:1"
          id="json"
          label="Colour specification (JSON)"
          suffix="json"
          file-name="{date}_{name}"
          starting-paint="optional"/>

  <xsl:output method="text" encoding="UTF-8"/>

  <xsl:param name="job-id"/>
  <xsl:param name="created-at"/>
  <xsl:param name="origin"/>
  <xsl:param name="copy"/>

  <xsl:template match="/spec:colorSpecification">
    <xsl:text>{&#10;  "format": "paintlink-color-1",&#10;  "job": {"id": </xsl:text>
    <xsl:call-template name="string"><xsl:with-param name="of" select="$job-id"/></xsl:call-template>
    <xsl:text>, "created": </xsl:text>
    <xsl:call-template name="string"><xsl:with-param name="of" select="$created-at"/></xsl:call-template>
    <xsl:text>, "origin": </xsl:text>
    <xsl:call-template name="string"><xsl:with-param name="of" select="$origin"/></xsl:call-template>
    <xsl:value-of select="concat(', &quot;copy&quot;: ', $copy, '}')"/>
    <xsl:apply-templates select="spec:name" mode="member"/>
    <xsl:apply-templates select="spec:code" mode="member"/>
    <xsl:apply-templates select="spec:finish" mode="member"/>
    <xsl:apply-templates select="spec:samples"/>
    <xsl:apply-templates select="spec:gloss"/>
    <xsl:apply-templates select="spec:spectra"/>
    <xsl:apply-templates select="spec:textures"/>
    <xsl:apply-templates select="spec:measurement"/>
    <xsl:apply-templates select="spec:startingPaint"/>
    <xsl:text>&#10;}&#10;</xsl:text>
  </xsl:template>

  <xsl:template match="spec:samples">
    <xsl:value-of select="concat(',&#10;  &quot;illumination_deg&quot;: ', @illumination)"/>
    <xsl:value-of select="concat(',&#10;  &quot;illuminant&quot;: &quot;', @illuminant, '&quot;')"/>
    <xsl:value-of select="concat(',&#10;  &quot;observer_deg&quot;: ', @observer)"/>
    <xsl:text>,&#10;  "samples": [</xsl:text>
    <xsl:apply-templates select="spec:sample" mode="item"/>
    <xsl:text>]</xsl:text>
  </xsl:template>

  <xsl:template match="spec:gloss">
    <xsl:value-of select="concat(',&#10;  &quot;gloss&quot;: {&quot;value_gu&quot;: ', @value)"/>
    <xsl:apply-templates select="@angle" mode="angle"/>
    <xsl:text>}</xsl:text>
  </xsl:template>

  <xsl:template match="spec:spectra">
    <xsl:text>,&#10;  "spectra": [</xsl:text>
    <xsl:for-each select="spec:spectrum">
      <xsl:call-template name="next-item"/>
      <xsl:value-of select="concat('{&quot;aspecular_deg&quot;: ', @aspecular)"/>
      <xsl:value-of select="concat(', &quot;start_nm&quot;: ', @start)"/>
      <xsl:value-of select="concat(', &quot;step_nm&quot;: ', @step, ', &quot;factors&quot;: [')"/>
      <xsl:for-each select="spec:factor">
        <xsl:if test="position() > 1">, </xsl:if>
        <xsl:value-of select="."/>
      </xsl:for-each>
      <xsl:text>]}</xsl:text>
    </xsl:for-each>
    <xsl:text>]</xsl:text>
  </xsl:template>

  <xsl:template match="spec:textures">
    <xsl:text>,&#10;  "textures": [</xsl:text>
    <xsl:for-each select="spec:texture">
      <xsl:call-template name="next-item"/>
      <xsl:text>{"name": </xsl:text>
      <xsl:call-template name="string"><xsl:with-param name="of" select="@name"/></xsl:call-template>
      <xsl:value-of select="concat(', &quot;value&quot;: ', @value)"/>
      <xsl:apply-templates select="@angle" mode="angle"/>
      <xsl:text>}</xsl:text>
    </xsl:for-each>
    <xsl:text>]</xsl:text>
  </xsl:template>

  <xsl:template match="spec:measurement">
    <xsl:text>,&#10;  "measurement": {"averaged": </xsl:text>
    <xsl:value-of select="spec:averaged"/>
    <xsl:apply-templates select="spec:instrument/*" mode="member"/>
    <xsl:apply-templates select="spec:time" mode="member"/>
    <xsl:apply-templates select="spec:origin" mode="member"/>
    <xsl:apply-templates select="spec:calibration" mode="member"/>
    <xsl:apply-templates select="spec:dataMode" mode="member"/>
    <xsl:text>}</xsl:text>
  </xsl:template>

  <xsl:template match="spec:startingPaint">
    <xsl:text>,&#10;  "starting_paint": {"total": </xsl:text>
    <xsl:value-of select="spec:differences/@total"/>
    <xsl:apply-templates select="spec:code" mode="member"/>
    <xsl:apply-templates select="spec:library" mode="member"/>
    <xsl:apply-templates select="spec:generation" mode="member"/>
    <xsl:apply-templates select="spec:formula" mode="member"/>
    <xsl:text>, "differences": [</xsl:text>
    <xsl:apply-templates select="spec:differences/spec:difference" mode="item"/>
    <xsl:text>]}</xsl:text>
  </xsl:template>

  <!-- An element with text as one more member of the object that is being written. -->
  <xsl:template match="*" mode="member">
    <xsl:choose>
      <xsl:when test="ancestor::spec:measurement or ancestor::spec:startingPaint">, "</xsl:when>
      <xsl:otherwise>,&#10;  "</xsl:otherwise>
    </xsl:choose>
    <xsl:choose>
      <xsl:when test="self::spec:dataMode">data_mode</xsl:when>
      <xsl:otherwise><xsl:value-of select="local-name()"/></xsl:otherwise>
    </xsl:choose>
    <xsl:text>": </xsl:text>
    <xsl:call-template name="string"><xsl:with-param name="of" select="."/></xsl:call-template>
  </xsl:template>

  <!-- An element whose attributes are all numbers as one more item of an array. -->
  <xsl:template match="*" mode="item">
    <xsl:call-template name="next-item"/>
    <xsl:value-of select="concat('{&quot;aspecular_deg&quot;: ', @aspecular)"/>
    <xsl:for-each select="@*[local-name() != 'aspecular']">
      <xsl:value-of select="concat(', &quot;', local-name(), '&quot;: ', .)"/>
    </xsl:for-each>
    <xsl:text>}</xsl:text>
  </xsl:template>

  <xsl:template match="@angle" mode="angle">
    <xsl:value-of select="concat(', &quot;angle_deg&quot;: ', .)"/>
  </xsl:template>

  <xsl:template name="next-item">
    <xsl:if test="position() > 1">,</xsl:if>
    <xsl:text>&#10;    </xsl:text>
  </xsl:template>

  <xsl:template name="string">
    <xsl:param name="of"/>
    <xsl:text>"</xsl:text>
    <xsl:call-template name="escaped"><xsl:with-param name="text" select="string($of)"/></xsl:call-template>
    <xsl:text>"</xsl:text>
  </xsl:template>

  <!-- One character and the rest: at most 500 deep, the length a text may have. -->
  <xsl:template name="escaped">
    <xsl:param name="text"/>
    <xsl:variable name="first" select="substring($text, 1, 1)"/>
    <xsl:choose>
      <xsl:when test="translate($text, '&quot;\&#9;&#10;&#13;', '') = $text">
        <xsl:value-of select="$text"/>
      </xsl:when>
      <xsl:otherwise>
        <xsl:choose>
          <xsl:when test="$first = '&quot;' or $first = '\'">
            <xsl:value-of select="concat('\', $first)"/>
          </xsl:when>
          <xsl:when test="$first = '&#9;'">\t</xsl:when>
          <xsl:when test="$first = '&#10;'">\n</xsl:when>
          <xsl:when test="$first = '&#13;'">\r</xsl:when>
          <xsl:otherwise><xsl:value-of select="$first"/></xsl:otherwise>
        </xsl:choose>
        <xsl:call-template name="escaped">
          <xsl:with-param name="text" select="substring($text, 2)"/>
        </xsl:call-template>
      </xsl:otherwise>
    </xsl:choose>
  </xsl:template>
</xsl:stylesheet>
